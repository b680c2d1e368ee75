//! A replay for people.

use crate::color::Rgb;
use crate::replay::{
    Chosen, Classes, Coordinates, Densities, FilmStart, Group, Proposal, Replay, SplatAt, State, Surface, Verdict,
    Vertex,
};
use std::fmt::{Display, Write};

/// Writes one line; writing to a `String` cannot fail.
macro_rules! line {
    ($out:expr, $($text:tt)*) => {{
        let _ = writeln!($out, $($text)*);
    }};
}

/// The whole replay.
pub fn text(replay: &Replay) -> String {
    let mut out = String::new();
    let Replay {
        technique,
        seed,
        chain,
        step,
        ..
    } = replay;
    match &replay.group {
        Some(group) => {
            line!(out, "{technique}, seed {seed}: chain {chain}, step {step}");
            write_group(&mut out, group);
        }
        None => line!(out, "{technique}, seed {seed}: pixel number {chain}, sample {step}"),
    }
    if let Some(state) = &replay.before {
        write_state(&mut out, "state before", state);
    }
    if let Some(mutation) = &replay.mutation {
        write_mutation(&mut out, mutation);
    }
    write_proposal(&mut out, &replay.proposal);
    if let Some(decision) = &replay.decision {
        write_decision(&mut out, decision);
    }
    if let Some(state) = &replay.after {
        let moved = replay.decision.is_some_and(|decision| decision.accepted);
        let title = if moved {
            "state after: the proposal"
        } else {
            "state after: as before"
        };
        write_state(&mut out, title, state);
    }
    out
}

fn write_group(out: &mut String, group: &Group) {
    let last = group.first_chain + group.chains.saturating_sub(1);
    line!(
        out,
        "  group        {}, chains {} to {last}; b = {:e} ± {:e} from {} samples",
        group.number,
        group.first_chain,
        group.b,
        group.b_error,
        group.samples
    );
    match group.started_from {
        Some(sample) => line!(
            out,
            "  started from sample of chain {}, round {}",
            sample.chain,
            sample.round
        ),
        None => line!(out, "  started from nothing: no sample of the bootstrap has any light"),
    }
}

fn write_state(out: &mut String, title: &str, state: &State) {
    line!(out, "\n{title}");
    line!(out, "  f(x)         {:e}", state.target);
    if state.target > 0.0 {
        write_class(out, &state.class);
    }
    if let Some(film) = &state.film {
        write_film(out, film);
    }
    write_coordinates(out, "coordinates ", &state.coordinates);
    write_coordinates(out, "of the light", &state.light_coordinates);
    write_splats(out, &state.splats);
    line!(out, "  unmoved for  {} steps", state.rejections);
}

fn write_class(out: &mut String, class: &Classes) {
    line!(
        out,
        "  class        {}; length {}; {}",
        class.block,
        class.length,
        class.signature
    );
}

fn write_film(out: &mut String, film: &FilmStart) {
    let ([x, y], [column, row]) = (film.position, film.pixel);
    let coordinates = film
        .coordinates
        .map(|[u, v]| format!(", coordinates {u:.9} {v:.9}"))
        .unwrap_or_default();
    line!(
        out,
        "  film         pixel ({column}, {row}), through ({x}, {y}){coordinates}"
    );
}

fn write_coordinates(out: &mut String, name: &str, coordinates: &[Coordinates]) {
    if coordinates.is_empty() {
        return;
    }
    line!(
        out,
        "  {name} depth  scatter              light       point on it          roulette"
    );
    for vertex in coordinates {
        let [s, t] = vertex.scatter;
        let light = vertex.light.map(|u| format!("{u:.8}")).unwrap_or_default();
        let point = vertex
            .light_point
            .map(|[u, v]| format!("{u:.7} {v:.7}"))
            .unwrap_or_default();
        let roulette = vertex.roulette.map(|u| format!("{u:.7}")).unwrap_or_default();
        let row = format!(
            "               {:<5}  {s:.7} {t:.7}  {light:<10}  {point:<19}  {roulette}",
            vertex.depth
        );
        line!(out, "{}", row.trim_end());
    }
}

fn write_splats(out: &mut String, splats: &[SplatAt]) {
    for splat in splats {
        let [column, row] = splat.pixel;
        line!(out, "  splat        pixel ({column}, {row}): {}", colour(splat.color));
    }
}

fn write_mutation(out: &mut String, mutation: &Chosen) {
    line!(
        out,
        "\nmutation       {}, chosen with probability {} (u = {}); from the proposal back with {}",
        mutation.name,
        mutation.probability,
        mutation.uniform,
        mutation.probability_back
    );
}

fn write_proposal(out: &mut String, proposal: &Proposal) {
    line!(out, "\nproposal");
    if let Some(film) = &proposal.film {
        write_film(out, film);
    }
    write_coordinates(out, "coordinates ", &proposal.coordinates);
    write_coordinates(out, "of the light", &proposal.light_coordinates);
    for vertex in &proposal.vertices {
        write_vertex(out, vertex);
    }
    if !proposal.light_vertices.is_empty() {
        line!(out, "  from the light");
    }
    for vertex in &proposal.light_vertices {
        write_vertex(out, vertex);
    }
    if let Some(contribution) = proposal.contribution {
        line!(out, "  light        {}", colour(contribution));
        if let Some(booked) = proposal.booked.filter(|_| !contribution.is_finite()) {
            line!(out, "  booked as    {}: it is not finite", colour(booked));
        }
    }
    if let Some(target) = proposal.target {
        line!(out, "  f(y)         {target:e}");
        if target > 0.0
            && let Some(class) = &proposal.class
        {
            write_class(out, class);
        }
    }
    write_splats(out, &proposal.splats);
    if let Some(densities) = &proposal.densities {
        write_densities(out, densities);
    }
}

fn write_vertex(out: &mut String, vertex: &Vertex) {
    let [x, y, z] = vertex.position;
    line!(
        out,
        "  vertex {:<5} {} at ({x}, {y}, {z}){}",
        vertex.depth,
        vertex.kind,
        place(vertex.surface.as_ref())
    );
    let mut field = |name: &str, value: &dyn Display| line!(out, "    {name:<14}{value}");
    let Some(surface) = &vertex.surface else { return };
    field("normal", &triple(surface.normal));
    if let Some(shading) = surface.shading_normal {
        field("shading normal", &format!(" {}", triple(shading)));
    }
    field(
        "f/p",
        &format!("{}, density {:e}", colour(vertex.ratio), vertex.density),
    );
    field("throughput", &colour(vertex.throughput));
    if !vertex.emission.is_black() {
        field("emission", &colour(vertex.emission));
    }
    if let Some(connection) = vertex.connection
        && !connection.is_black()
    {
        field("connection", &colour(connection));
    }
    if !vertex.light.is_black() {
        field("adds", &colour(vertex.light));
    }
}

/// What a vertex is on, in words.
fn place(surface: Option<&Surface>) -> String {
    let Some(surface) = surface else {
        return String::new();
    };
    let mut text = String::new();
    if let (Some(shape), Some(instance)) = (&surface.shape, surface.instance) {
        let _ = write!(text, " on {shape} (shape {instance})");
    }
    if let (Some(primitive), Some([u, v])) = (surface.primitive, surface.uv) {
        let _ = write!(text, ", primitive {primitive} at {u:.6} {v:.6}");
    }
    if let Some(material) = &surface.material {
        let _ = write!(text, ", {material}");
    }
    text
}

fn write_densities(out: &mut String, densities: &Densities) {
    let mut way = |name, sum: f64, way: usize| {
        line!(
            out,
            "  {name}    {sum} = choice {} + own {} + common {}",
            densities.choice[way],
            densities.own[way],
            densities.common
        );
    };
    way("ln T(x→y)", densities.forward, 0);
    way("ln T(y→x)", densities.reverse, 1);
}

fn write_decision(out: &mut String, decision: &Verdict) {
    let compared = decision
        .uniform
        .map(|u| format!("; u = {u}"))
        .unwrap_or_else(|| "; nothing was drawn".to_owned());
    let taken = if decision.accepted { "taken" } else { "turned down" };
    line!(
        out,
        "\ndecision       {taken}: a(x→y) = {}{compared} ({})",
        decision.acceptance,
        decision.reason
    );
}

fn colour(value: Rgb) -> String {
    let [r, g, b] = value.to_array();
    format!("({r:e}, {g:e}, {b:e})")
}

fn triple([x, y, z]: [f32; 3]) -> String {
    format!("({x}, {y}, {z})")
}
