//! The sieve lets through whatever is hit, and what it calls certain is.
//!
//! Guarded so: each of the slacks is taken away in a twin of the sieve, and the same pairs tell. By hand, with the constants set to zero:
//! without `EDGE_ON` the nearest hit is lost among sheets that rays graze.

mod pairs;
mod promise;

use super::{Bundle, CHUNK, Ends};
use glam::DVec3;
use pairs::{Dice, Kind, broken_line, line};
use promise::{Broken, How, Line, Tally, Triangles, check};

/// How large scenes are, and how far from the origin.
const PLACES: [(f64, f64); 6] = [
    (1.0, 0.0),
    (1.0, 1e6),
    (1e-3, 1.0),
    (1e-20, 0.0),
    (1e20, 0.0),
    (1e5, 1e6),
];

/// One mesh and lines towards it.
fn scene(dice: &mut Dice, kind: Kind, count: usize, (scale, distance): (f64, f64)) -> (Triangles, Vec<Line>) {
    let center = dice.direction() * distance;
    let mesh = kind.mesh(dice, count, scale, center);
    // No multiple of sixteen.
    let lines = (0..217).map(|_| {
        let towards = dice.pick(&mesh);
        line(dice, towards, scale, center)
    });
    let lines = lines.collect();
    (Triangles::new(&mesh), lines)
}

/// Goes through meshes of so many triangles of all kinds at all places.
fn go_through(
    seed: u64,
    counts: &[usize],
    mut each: impl FnMut(&mut Triangles, &[Line]) -> Result<(), Broken>,
) -> Result<(), Broken> {
    let mut dice = Dice::new(seed);
    for kind in Kind::ALL {
        for place in PLACES {
            for &count in counts {
                let (mut triangles, lines) = scene(&mut dice, kind, count, place);
                each(&mut triangles, &lines)?;
            }
        }
    }
    Ok(())
}

#[test]
fn what_is_hit_is_let_through_and_what_is_certain_is_hit() {
    let mut tally = Tally::default();
    let all = go_through(1, &[3, 20, 61, 62, 63, 140], |triangles, lines| {
        for how in How::SOUND {
            tally.add(check(triangles, lines, how)?);
        }
        Ok(())
    });
    all.unwrap_or_else(|broken| panic!("{broken}"));
    // That much is looked at, and that much is decided at once.
    assert!(tally.pairs > 10_000_000 && tally.hits > 1_000_000, "{tally:?}");
    assert!(tally.open * 2 < tally.pairs && tally.certain > 500_000, "{tally:?}");
}

#[test]
fn numbers_that_are_none_or_too_large_are_let_through() {
    let mut dice = Dice::new(2);
    let all = go_through(3, &[5, 70], |triangles, lines| {
        let broken: Vec<Line> = lines.iter().map(|&sound| broken_line(&mut dice, sound)).collect();
        for how in How::SOUND {
            check(triangles, &broken, how)?;
        }
        Ok(())
    });
    all.unwrap_or_else(|broken| panic!("{broken}"));
}

/// A ray meets the triangle at the other end of its chunk, and of the chunk after.
#[test]
fn a_hit_in_one_chunk_hides_what_is_behind_it_in_the_next() {
    let sheet = |z: f64| {
        [
            DVec3::new(-1.0, -1.0, z),
            DVec3::new(3.0, -1.0, z),
            DVec3::new(-1.0, 3.0, z),
        ]
    };
    let mesh: Vec<_> = (0..150)
        .map(|i| sheet(f64::from(i) / 150.0).map(|p| p.as_vec3()))
        .collect();
    let lines: Vec<Line> = (0..33)
        .map(|i| (DVec3::new(0.0, 0.01 * f64::from(i), -1.0).as_vec3(), DVec3::Z))
        .collect();
    let tally = check(&Triangles::new(&mesh), &lines, How::SOUND[2]).unwrap_or_else(|broken| panic!("{broken}"));
    // The first of the first chunk, and no other of any.
    assert_eq!((tally.certain, tally.open), (tally.pairs / 150, tally.pairs / 150));
}

/// What each mistake in the sieve makes of the same scenes.
fn seen(how: How, plant: impl Fn(&mut Triangles)) {
    let found = [1, 4].into_iter().try_for_each(|seed| {
        go_through(seed, &[20, 140], |triangles, lines| {
            plant(triangles);
            check(triangles, lines, how).map(drop)
        })
    });
    assert!(found.is_err(), "a mistake is not seen");
}

#[test]
fn slack_of_sides_that_is_left_out_is_seen() {
    for how in How::SOUND {
        seen(how, |triangles| {
            triangles.facets.iter_mut().for_each(|facet| facet.slack = 0.0);
        });
        seen(how, |triangles| {
            triangles.facets.iter_mut().for_each(|facet| facet.slack_by_reach = 0.0);
        });
    }
}

#[test]
fn slack_for_the_exact_test_that_is_left_out_is_seen() {
    let without: fn(&mut Bundle) = |bundle| bundle.slack = [0.0; super::BUNDLE];
    for ends in [Ends::AtTheNearest, Ends::AtTheTarget] {
        let how = How {
            ends,
            chunk: 1,
            plant: without,
        };
        seen(how, |_| {});
    }
}

#[test]
fn slack_of_heights_that_is_left_out_is_seen() {
    for how in How::SOUND {
        seen(how, |triangles| {
            triangles.facets.iter_mut().for_each(|facet| facet.height_slack = 0.0);
        });
        // Heights of single precision with the slack of double.
        seen(how, |triangles| {
            triangles
                .facets
                .iter_mut()
                .for_each(|facet| facet.height = f64::from(facet.height as f32));
        });
    }
}

/// Distances are compared with the plane's normal in single precision, which is far off where rays graze the plane.
#[test]
fn normals_that_are_off_are_seen() {
    let how = How {
        ends: Ends::AtTheNearest,
        chunk: CHUNK,
        plant: |_| {},
    };
    seen(how, |triangles| {
        let every_other = triangles.facets.iter_mut().step_by(2);
        every_other.for_each(|facet| facet.plane = facet.plane.map(|x| x * (1.0 + 1e-3)));
    });
}
