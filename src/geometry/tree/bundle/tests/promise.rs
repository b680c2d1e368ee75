//! What the sieve promises, checked pair by pair against the exact test.

use super::super::{BUNDLE, Bundle, CHUNK, Ends, NONE, Sift, Sifted};
use crate::geometry::tracer::Instructions;
use crate::geometry::tree::facet::{Facet, Frame};
#[cfg(target_arch = "x86_64")]
use crate::geometry::tree::lanes::{Avx2, Avx512};
use crate::geometry::tree::lanes::{Lanes, Plain};
use crate::geometry::tree::query::{Blocked, Nearest, Query};
use crate::geometry::tree::walk::Prepared;
use crate::geometry::triangle::{CornerRows, RayFrame};
use glam::{DVec3, Vec3};

/// An origin and a direction, or the way to a target.
pub type Line = (Vec3, DVec3);

/// Triangles, and what the sieve knows of them.
pub struct Triangles {
    rows: Vec<CornerRows>,
    pub facets: Vec<Facet>,
    frame: Frame,
    /// The largest coordinate.
    reach: f64,
}

impl Triangles {
    /// Those that have an area, as only they are traced.
    pub fn new(corners: &[[Vec3; 3]]) -> Self {
        let has_area = |[a, b, c]: &&[Vec3; 3]| {
            let [a, b, c] = [a, b, c].map(|corner| corner.as_dvec3());
            a.is_finite() && b.is_finite() && c.is_finite() && (b - a).cross(c - a).length_squared() > 0.0
        };
        let rows = |corners: &[Vec3; 3]| [0, 1, 2].map(|axis| corners.map(|corner| corner[axis]));
        let sound: Vec<[Vec3; 3]> = corners.iter().filter(has_area).copied().collect();
        let all = sound.concat();
        let low = all.iter().copied().fold(Vec3::INFINITY, Vec3::min);
        let high = all.iter().copied().fold(Vec3::NEG_INFINITY, Vec3::max);
        let frame = Frame::around(low, high);
        let rows: Vec<CornerRows> = sound.iter().map(rows).collect();
        let facets = rows.iter().map(|rows| Facet::new(rows, frame)).collect();
        let reach = f64::from(low.abs().max(high.abs()).max_element());
        Self {
            rows,
            facets,
            frame,
            reach,
        }
    }
}

/// What the exact test says of a pair.
#[derive(Clone, Copy, Default)]
struct Exact {
    /// Where it is hit, if it is where that counts.
    t: Option<f64>,
    /// Whether the ray enters the triangle's box too.
    is_entered: bool,
}

fn exact(rows: &CornerRows, ray: &Prepared, ends: Ends) -> Exact {
    let bounds = rows.map(|row| [row[0].min(row[1]).min(row[2]), row[0].max(row[1]).max(row[2])]);
    let of = |counts: fn(f64) -> bool, limit: fn(f64, &Prepared) -> f32| {
        let t = ray.frame.cross(rows).map(|crossing| crossing.t).filter(|&t| counts(t));
        let is_entered = t.is_some_and(|t| ray.boxes.enters(bounds, limit(t, ray)));
        Exact { t, is_entered }
    };
    match ends {
        Ends::AtTheNearest => of(|t| Nearest::new().counts(t), |t, ray| Nearest::new().box_limit(t, ray)),
        Ends::AtTheTarget => of(|t| Blocked::new().counts(t), |t, ray| Blocked::new().box_limit(t, ray)),
    }
}

/// In words, a promise that was broken: what is hit was neither left open nor behind a certain hit, or what was said to be certain is no hit.
pub type Broken = String;

/// How much was looked at, by all instructions together.
#[derive(Clone, Copy, Debug, Default)]
pub struct Tally {
    /// Pairs of a ray and a triangle.
    pub pairs: usize,
    /// Those that the exact test hits.
    pub hits: usize,
    /// Those that were left open.
    pub open: usize,
    /// Rays that were told of a certain hit, once for each chunk.
    pub certain: usize,
}

impl Tally {
    pub fn add(&mut self, other: Self) {
        self.pairs += other.pairs;
        self.hits += other.hits;
        self.open += other.open;
        self.certain += other.certain;
    }
}

/// How triangles and lines are gone through.
#[derive(Clone, Copy)]
pub struct How {
    pub ends: Ends,
    /// Triangles in a chunk, at most [`CHUNK`]: one, and every pair is judged by itself.
    pub chunk: usize,
    /// What is done to every bundle: nothing, or a mistake that is to be seen.
    pub plant: fn(&mut Bundle),
}

impl How {
    /// All ways without a mistake.
    pub const SOUND: [Self; 4] = [
        Self::of(Ends::AtTheNearest, 1),
        Self::of(Ends::AtTheTarget, 1),
        Self::of(Ends::AtTheNearest, CHUNK),
        Self::of(Ends::AtTheTarget, CHUNK),
    ];

    const fn of(ends: Ends, chunk: usize) -> Self {
        Self {
            ends,
            chunk,
            plant: |_| {},
        }
    }
}

/// Checks every line against every triangle, by all instructions that are here.
pub fn check(triangles: &Triangles, lines: &[Line], how: How) -> Result<Tally, Broken> {
    let mut tally = Tally::default();
    for bundle in lines.chunks(BUNDLE) {
        let table: Vec<Vec<Exact>> = bundle
            .iter()
            .map(|&(origin, direction)| {
                let ray = Prepared::new(RayFrame::new(origin, direction), triangles.reach);
                let each = triangles.rows.iter();
                each.map(|rows| exact(rows, &ray, how.ends)).collect()
            })
            .collect();
        for instructions in Instructions::ALL {
            let checked = match instructions {
                Instructions::Plain => Some(check_bundle(Plain, triangles, bundle, &table, how)),
                #[cfg(target_arch = "x86_64")]
                Instructions::Avx2 => Avx2::detect().map(|lanes| check_bundle(lanes, triangles, bundle, &table, how)),
                #[cfg(target_arch = "x86_64")]
                Instructions::Avx512 => {
                    Avx512::detect().map(|lanes| check_bundle(lanes, triangles, bundle, &table, how))
                }
                #[cfg(not(target_arch = "x86_64"))]
                _ => None,
            };
            tally.add(checked.transpose()?.unwrap_or_default());
        }
    }
    Ok(tally)
}

fn check_bundle<L: Lanes>(
    lanes: L,
    triangles: &Triangles,
    lines: &[Line],
    table: &[Vec<Exact>],
    how: How,
) -> Result<Tally, Broken> {
    let (mut bundle, mut sifted, mut tally) = (Bundle::EMPTY, Sifted::NOTHING, Tally::default());
    let prepare = || {
        let mut bundle = Bundle::EMPTY;
        for (place, &(origin, direction)) in lines.iter().enumerate() {
            bundle.put(place, origin, direction, how.ends);
        }
        bundle.prepare(triangles.frame, how.ends);
        (how.plant)(&mut bundle);
        bundle
    };
    // What each ray may take for granted: how far a certain hit is, or that it is blocked.
    let mut granted = vec![f64::INFINITY; lines.len()];
    for (number, facets) in triangles.facets.chunks(how.chunk).enumerate() {
        let first = number * how.chunk;
        if number == 0 || how.chunk == 1 {
            bundle = prepare();
            granted.fill(f64::INFINITY);
        }
        lanes.run(Sift {
            facets,
            bundle: &mut bundle,
            ends: how.ends,
            sifted: &mut sifted,
        });
        for (place, line) in lines.iter().enumerate() {
            let exact = &table[place][first..][..facets.len()];
            let say = |what: &str, facet: usize| {
                let rows = triangles.rows[first + facet];
                format!(
                    "{what}: {line:?} and {rows:?}, number {}: {:?}",
                    first + facet,
                    exact[facet].t
                )
            };
            let mut named = None;
            if how.ends == Ends::AtTheNearest && sifted.certain >> place & 1 != 0 {
                let facet = sifted.nearest[place] as usize;
                match exact[facet] {
                    Exact {
                        t: Some(t),
                        is_entered: true,
                    } => granted[place] = granted[place].min(t),
                    _ => return Err(say("not certain", facet)),
                }
                named = Some(facet);
                tally.certain += 1;
            } else if how.ends == Ends::AtTheNearest {
                assert!(sifted.nearest[place] == NONE);
            }
            if how.ends == Ends::AtTheTarget && sifted.blocked >> place & 1 != 0 {
                if !exact.iter().any(|pair| pair.is_entered) {
                    return Err(say("not blocked", 0));
                }
                granted[place] = f64::NEG_INFINITY;
                tally.certain += 1;
            }
            tally.pairs += facets.len();
            for (facet, pair) in exact.iter().enumerate() {
                let is_open = sifted.open[facet] >> place & 1 != 0;
                tally.open += usize::from(is_open);
                let Some(t) = pair.t else {
                    continue;
                };
                tally.hits += 1;
                if !is_open && named != Some(facet) && t <= granted[place] {
                    return Err(say("lost", facet));
                }
            }
        }
    }
    Ok(tally)
}
