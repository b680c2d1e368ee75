//! What a ray costs: nanoseconds by kind of ray, size of scene, tracer and instructions, beside Embree's.
//!
//! `cargo bench --bench rays -- [--embree libembree4.so] [--threads N] [--rays N] [SCENE...]`, scenes being shipped ones by
//! name, or a bumpy room of so many triangles: `box`, `glass-box`, `20k`, `2m`. The library
//! is the one that PyPI's `embreex` brings, or any other build of Embree 4. Rounds interleave all ways in one process, so that ratios of
//! medians hold on a noisy machine. Hits are compared too.
#![expect(clippy::print_stdout, reason = "a benchmark prints its table")]

#[path = "support/embree.rs"]
mod embree;
mod support;

use chainlight::color::Rgb;
use chainlight::geometry::{
    Geometry, HitColumns, HitDistance, HitInstance, HitPrimitive, HitUv, Instructions, NO_HIT, RayColumns,
    RayDirection, RayOrigin, SegmentColumns, SegmentTarget, SegmentTransmittance, Tracer,
};
use chainlight::sampling::{Purpose, Stream, StreamKey};
use chainlight::table::{Column, Rows, lane_groups};
use clap::Parser;
use embree::{Embree, EmbreeRay};
use glam::Vec3;
use std::path::PathBuf;
use std::time::Instant;
use support::{bumpy_room, median, shipped};

/// What a ray costs.
#[derive(Debug, Parser)]
struct Arguments {
    /// Scenes: `box` and other shipped ones by name, or a bumpy room of so many triangles, such as `20k` or `2m`; box, 20k, 200k and 2m if none
    /// is given.
    scenes: Vec<String>,
    /// Embree's shared library.
    #[arg(long)]
    embree: Option<PathBuf>,
    /// Threads.
    #[arg(long, default_value_t = 1)]
    threads: usize,
    /// Rays of each kind.
    #[arg(long, default_value_t = 1 << 17)]
    rays: usize,
    /// Rounds.
    #[arg(long, default_value_t = 9)]
    rounds: usize,
    /// Rays in flight.
    #[arg(long, value_delimiter = ',', default_value = "16")]
    in_flight: Vec<u32>,
    /// Instructions; all that the machine has if none are given.
    #[arg(long, value_delimiter = ',')]
    instructions: Vec<String>,
    /// Ignored: cargo passes it.
    #[arg(long)]
    bench: bool,
}

/// Rays in a tile of the renderer.
const TILE: usize = 1024;

/// An origin and a direction, or the span to the end of a segment.
type Ray = (Vec3, Vec3);

/// Rays of one kind.
struct Kind {
    name: &'static str,
    rays: Vec<Ray>,
    are_segments: bool,
}

fn main() {
    let arguments = Arguments::parse();
    println!(
        "{} threads, {} rays of each kind; ns per ray and thread, and how many times as fast as Embree",
        arguments.threads, arguments.rays
    );
    let all = ["box", "20k", "200k", "2m"].map(str::to_owned).to_vec();
    let names = if arguments.scenes.is_empty() {
        all
    } else {
        arguments.scenes.clone()
    };
    for name in names {
        let scene = match name.as_str() {
            "box" => shipped("cornell-box", 8),
            name => count(name).map_or_else(|| shipped(name, 8), |triangles| bumpy_room(triangles, 8)),
        };
        measure(&name, &scene.geometry, &arguments);
    }
}

/// A number such as 64, 20k or 2m.
fn count(name: &str) -> Option<usize> {
    let digits = name.trim_end_matches(['k', 'm']);
    let unit = match &name[digits.len()..] {
        "k" => 1_000,
        "m" => 1_000_000,
        _ => 1,
    };
    digits.parse::<usize>().ok().map(|number| unit * number)
}

/// One way to trace.
struct Way {
    name: String,
    trace: Option<(Tracer, Instructions)>,
    rounds: Vec<f64>,
    distances: Vec<f32>,
}

fn measure(name: &str, geometry: &Geometry, arguments: &Arguments) {
    let mut geometry = geometry.clone();
    let triangles: Vec<[Vec3; 3]> = geometry.triangles().collect();
    let began = Instant::now();
    geometry.build_tree();
    let built = began.elapsed().as_secs_f64();
    print!(
        "\n{name}: {} triangles; built in {built:.3} s, {:.1} bytes a triangle",
        triangles.len(),
        geometry.tree_bytes() as f64 / triangles.len() as f64
    );
    let embree = arguments
        .embree
        .as_ref()
        .map(|path| Embree::build(path, &triangles).expect("Embree's library"));
    if let Some(embree) = &embree {
        print!("; Embree built in {:.3} s", embree.build_time.as_secs_f64());
    }
    println!();
    let mut bench = Bench {
        geometry,
        embree,
        threads: arguments.threads,
    };
    for kind in kinds(&bench.geometry, arguments.rays) {
        let mut ways = ways(&bench, arguments);
        for _ in 0..arguments.rounds {
            for way in &mut ways {
                let (nanoseconds, distances) = bench.round(way.trace, &kind);
                way.rounds.push(nanoseconds);
                way.distances = distances;
            }
        }
        let base = bench.embree.as_ref().map(|_| median(ways[0].rounds.clone()));
        let mut line = format!("{:<9}", kind.name);
        for way in &ways {
            let own = median(way.rounds.clone());
            line += &format!("  {} {own:.1}", way.name);
            if let Some(base) = base
                && way.trace.is_some()
            {
                line += &format!(" ({:.2})", base / own);
            }
        }
        let other = ways
            .last()
            .map_or(0, |last| differing(&ways[0].distances, &last.distances));
        println!("{line}  {other} differ");
    }
}

fn ways(bench: &Bench, arguments: &Arguments) -> Vec<Way> {
    let way = |name: String, trace| Way {
        name,
        trace,
        rounds: Vec::new(),
        distances: Vec::new(),
    };
    let mut ways: Vec<Way> = bench.embree.iter().map(|_| way("Embree".into(), None)).collect();
    for instructions in Instructions::ALL
        .into_iter()
        .filter(|instructions| instructions.are_here())
    {
        let asked = &arguments.instructions;
        if !asked.is_empty()
            && !asked
                .iter()
                .any(|name| *name == format!("{instructions:?}").to_lowercase())
        {
            continue;
        }
        let mut tracers = vec![Tracer::OneByOne];
        if bench.geometry.primitive_count() < 300 {
            tracers.push(Tracer::All);
        }
        tracers.extend(arguments.in_flight.iter().map(|&rays| Tracer::Interleaved(rays)));
        for tracer in tracers {
            ways.push(way(
                format!("{tracer:?}/{instructions:?}"),
                Some((tracer, instructions)),
            ));
        }
    }
    ways
}

/// How many rays two ways answer differently, by more than rounding.
fn differing(a: &[f32], b: &[f32]) -> usize {
    let differ = |(&a, &b): (&f32, &f32)| a.is_finite() != b.is_finite() || (a - b).abs() > 1e-3 * a.abs().min(b.abs());
    a.iter().zip(b).filter(|&pair| differ(pair)).count()
}

struct Bench {
    geometry: Geometry,
    embree: Option<Embree>,
    threads: usize,
}

impl Bench {
    /// Nanoseconds per ray and thread, and the distances found: of segments infinite where they are free and 0 where not.
    fn round(&mut self, trace: Option<(Tracer, Instructions)>, kind: &Kind) -> (f64, Vec<f32>) {
        if let Some((tracer, instructions)) = trace {
            self.geometry.trace_with(tracer, instructions);
        }
        let this = &*self;
        let share = kind.rays.len().div_ceil(self.threads);
        let parts: Vec<_> = std::thread::scope(|scope| {
            let threads: Vec<_> = kind
                .rays
                .chunks(share)
                .map(|rays| {
                    scope.spawn(move || match trace {
                        None => this.by_embree(rays, kind.are_segments),
                        Some(_) if kind.are_segments => transmittances(&this.geometry, rays),
                        Some(_) => closest(&this.geometry, rays),
                    })
                })
                .collect();
            threads
                .into_iter()
                .map(|thread| thread.join().expect("a thread"))
                .collect()
        });
        let slowest = parts.iter().map(|(seconds, _)| *seconds).fold(0.0, f64::max);
        let distances = parts.into_iter().flat_map(|(_, distances)| distances).collect();
        (1e9 * slowest / share as f64, distances)
    }

    fn by_embree(&self, rays: &[Ray], are_segments: bool) -> (f64, Vec<f32>) {
        let embree = self.embree.as_ref().expect("asked for");
        let far = if are_segments { 1.0 } else { f32::INFINITY };
        let mut rays: Vec<EmbreeRay> = rays
            .iter()
            .map(|&(origin, direction)| EmbreeRay::new(origin, direction, far))
            .collect();
        let began = Instant::now();
        for ray in &mut rays {
            if are_segments {
                embree.blocked(ray);
            } else {
                embree.closest_hit(ray);
            }
        }
        let seconds = began.elapsed().as_secs_f64();
        let distance = |ray: &EmbreeRay| match ray.distance() {
            blocked if blocked < 0.0 => 0.0,
            _ if are_segments => f32::INFINITY,
            distance => distance,
        };
        (seconds, rays.iter().map(distance).collect())
    }
}

fn column<C: Column>(rows: usize) -> Vec<C> {
    (0..lane_groups(rows)).map(|_| C::zeroed()).collect()
}

fn filled<C: Column>(values: impl ExactSizeIterator<Item = C::Value>) -> Vec<C> {
    let mut column = column(values.len());
    for (i, value) in values.enumerate() {
        column.put(i, value);
    }
    column
}

/// Seconds in the tracer, and the distances of hits. In queues as long as the renderer's.
fn closest(geometry: &Geometry, rays: &[Ray]) -> (f64, Vec<f32>) {
    let (mut distance, mut instance) = (column::<HitDistance>(TILE), column::<HitInstance>(TILE));
    let (mut primitive, mut uv) = (column::<HitPrimitive>(TILE), column::<HitUv>(TILE));
    let (mut seconds, mut distances) = (0.0, Vec::with_capacity(rays.len()));
    for tile in rays.chunks(TILE) {
        let origin: Vec<RayOrigin> = filled(tile.iter().map(|ray| ray.0));
        let direction: Vec<RayDirection> = filled(tile.iter().map(|ray| ray.1));
        let began = Instant::now();
        geometry.closest_hits(
            RayColumns {
                origin: &origin,
                direction: &direction,
                len: tile.len(),
            },
            HitColumns {
                distance: &mut distance,
                instance: &mut instance,
                primitive: &mut primitive,
                uv: &mut uv,
            },
        );
        seconds += began.elapsed().as_secs_f64();
        distances.extend((0..tile.len()).map(|i| distance.at(i)));
    }
    (seconds, distances)
}

fn transmittances(geometry: &Geometry, rays: &[Ray]) -> (f64, Vec<f32>) {
    let mut transmittance = column::<SegmentTransmittance>(TILE);
    let (mut seconds, mut distances) = (0.0, Vec::with_capacity(rays.len()));
    for tile in rays.chunks(TILE) {
        let origin: Vec<RayOrigin> = filled(tile.iter().map(|ray| ray.0));
        let target: Vec<SegmentTarget> = filled(tile.iter().map(|ray| ray.0 + ray.1));
        let segments = SegmentColumns {
            origin: &origin,
            target: &target,
            len: tile.len(),
        };
        let began = Instant::now();
        geometry.transmittances(segments, &mut transmittance);
        seconds += began.elapsed().as_secs_f64();
        let passes = |i: usize| {
            if transmittance.at(i) != Rgb::BLACK {
                f32::INFINITY
            } else {
                0.0
            }
        };
        distances.extend((0..tile.len()).map(passes));
    }
    (seconds, distances)
}

/// Primary rays around a point, in the order of pixels; diffuse bounces of theirs, in no order; segments from there to a light; and chains of
/// mirror reflections.
fn kinds(geometry: &Geometry, count: usize) -> Vec<Kind> {
    let mut stream = StreamKey::new(7, 0, 0).stream(Purpose::FILM, 0);
    let (low, high) = geometry.bounds().expect("a scene");
    let primary = around(0.5 * (low + high), count);
    let mut bounces: Vec<Ray> = Vec::new();
    let mut mirrored: Vec<Ray> = Vec::new();
    let (mut diffuse, mut mirror) = (primary.clone(), primary.clone());
    for _ in 0..4 {
        diffuse = next(geometry, &diffuse, |direction, normal| {
            loop {
                let drawn = normal * if direction.dot(normal) < 0.0 { 1.0 } else { -1.0 } + unit(&mut stream);
                if drawn.length() > 1e-3 {
                    break drawn.normalize();
                }
            }
        });
        mirror = next(geometry, &mirror, |direction, normal| {
            (direction - normal * 2.0 * direction.dot(normal)).normalize()
        });
        bounces.extend(&diffuse);
        mirrored.extend(&mirror);
    }
    shuffle(&mut bounces, &mut stream);
    bounces.truncate(count);
    mirrored.truncate(count);
    let light = |u: f32, v: f32| low + (high - low) * Vec3::new(0.3 + 0.4 * u, 0.998, 0.3 + 0.4 * v);
    let shadow = bounces
        .iter()
        .map(|&(origin, _)| (origin, light(stream.next_f32(), stream.next_f32()) - origin))
        .collect();
    let kind = |name, rays, are_segments| Kind {
        name,
        rays,
        are_segments,
    };
    vec![
        kind("primary", primary, false),
        kind("bounce", bounces, false),
        kind("mirror", mirrored, false),
        kind("shadow", shadow, true),
    ]
}

fn around(center: Vec3, count: usize) -> Vec<Ray> {
    let side = (count as f64).sqrt() as usize;
    let directions = (0..side * side).map(|pixel| {
        let [x, y] = [pixel % side, pixel / side].map(|i| 2.0 * (i as f32 + 0.5) / side as f32 - 1.0);
        Vec3::new(x, y, -0.7).normalize()
    });
    directions.map(|direction| (center, direction)).collect()
}

fn unit(stream: &mut Stream) -> Vec3 {
    loop {
        let v = Vec3::new(stream.next_f32(), stream.next_f32(), stream.next_f32()) * 2.0 - 1.0;
        if v.length_squared() > 1e-3 && v.length_squared() < 1.0 {
            return v.normalize();
        }
    }
}

fn shuffle(rays: &mut [Ray], stream: &mut Stream) {
    for last in (1..rays.len()).rev() {
        let other = (f64::from(stream.next_f32()) * (last + 1) as f64) as usize;
        rays.swap(last, other.min(last));
    }
}

/// What rays do where they hit: go on from there, along a direction made of theirs and the surface's normal.
fn next(geometry: &Geometry, rays: &[Ray], mut turn: impl FnMut(Vec3, Vec3) -> Vec3) -> Vec<Ray> {
    let mut on = Vec::with_capacity(rays.len());
    let (mut distance, mut instance) = (column::<HitDistance>(TILE), column::<HitInstance>(TILE));
    let (mut primitive, mut uv) = (column::<HitPrimitive>(TILE), column::<HitUv>(TILE));
    for tile in rays.chunks(TILE) {
        let origin: Vec<RayOrigin> = filled(tile.iter().map(|ray| ray.0));
        let direction: Vec<RayDirection> = filled(tile.iter().map(|ray| ray.1));
        let rays = RayColumns {
            origin: &origin,
            direction: &direction,
            len: tile.len(),
        };
        let hits = HitColumns {
            distance: &mut distance,
            instance: &mut instance,
            primitive: &mut primitive,
            uv: &mut uv,
        };
        geometry.closest_hits(rays, hits);
        for (i, &(origin, direction)) in tile.iter().enumerate() {
            if instance.at(i) == NO_HIT {
                continue;
            }
            let Some([a, b, c]) = geometry.triangle(instance.at(i), primitive.at(i)) else {
                continue;
            };
            let normal = (b - a).cross(c - a).normalize_or_zero();
            let at = origin + direction * distance.at(i);
            let side = if direction.dot(normal) < 0.0 { normal } else { -normal };
            on.push((at + side * (1e-5 * at.abs().max_element()), turn(direction, normal)));
        }
    }
    on
}
