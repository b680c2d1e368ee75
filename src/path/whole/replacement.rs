//! What of a path is replaced by how much.

/// The bidirectional mutation's choice of what it replaces by how much (Veach 1997, §11.3.1).
///
/// Of a path with k edges n vertices are taken out of the middle, or off an end; the first t₀ and the last s₀ are kept. A lens, or
/// a light, is not kept alone: whoever draws the edge that begins there anew draws it with the edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Replacement {
    /// The fewest edges of a path.
    pub shortest: u32,
    /// The most, not fewer.
    pub longest: u32,
}

/// What is taken out of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Deletion {
    /// Vertices that are taken out, n.
    pub vertices: u32,
    /// Vertices that are kept from the camera, t₀.
    pub from_camera: u32,
    /// Vertices that are kept from the light, s₀.
    pub from_light: u32,
}

impl Deletion {
    /// Whether an end of the path is gone, so that at least one vertex has to come for it.
    #[must_use]
    pub const fn takes_an_end(&self) -> bool {
        self.from_camera == 0 || self.from_light == 0
    }
}

/// How likely a deletion is by the number of vertices that it takes, relative to others: that of an edge alone ¼, of one vertex
/// ½, of n 2⁻ⁿ⁻¹ (Veach 1997, §11.3.1).
fn deletion_weight(vertices: u32) -> f64 {
    match vertices {
        0 => 0.25,
        1 => 0.5,
        n => libm::exp2(-f64::from(n) - 1.0),
    }
}

/// How likely it is that a path grows by `difference` edges, relative to others: ½ to stay, 0.15 each for one more or less,
/// 0.2 · 2⁻ⁿ each for n (Veach 1997, §11.3.1).
fn growth_weight(difference: i64) -> f64 {
    match difference.unsigned_abs() {
        0 => 0.5,
        1 => 0.15,
        n => 0.2 * libm::exp2(-(n as f64)),
    }
}

/// Ways to keep `kept` vertices at both ends where `vertices` are taken.
fn ways(kept: u32, vertices: u32) -> u32 {
    match (vertices, kept) {
        // Both ends: 2 ≤ t₀ ≤ kept − 2.
        (0, _) => kept.saturating_sub(3),
        (_, 0) => 1,
        (_, 1) => 0,
        (_, 2) => 2,
        _ => kept - 1,
    }
}

impl Replacement {
    /// What is taken out of a path with `length` edges, as `u` and `v` in [0, 1) choose.
    #[must_use]
    pub fn delete(&self, length: u32, u: f64, v: f64) -> Deletion {
        let sum: f64 = self.deletion_weights(length).map(|(_, weight)| weight).sum();
        let mut left = u * sum;
        let mut chosen = length + 1;
        for (vertices, weight) in self.deletion_weights(length) {
            if weight > 0.0 {
                chosen = vertices;
                if left < weight {
                    break;
                }
                left -= weight;
            }
        }
        let kept = length + 1 - chosen;
        let ways = ways(kept, chosen);
        let way = ((v * f64::from(ways)) as u32).min(ways - 1);
        let from_camera = match (chosen, way) {
            (0, way) => way + 2,
            (_, 0) => 0,
            (_, 1) => kept,
            (_, way) => way,
        };
        Deletion {
            vertices: chosen,
            from_camera,
            from_light: kept - from_camera,
        }
    }

    /// The probability of a deletion from a path with `length` edges.
    #[must_use]
    pub fn deletion(&self, length: u32, deletion: Deletion) -> f64 {
        let ways = ways(length + 1 - deletion.vertices, deletion.vertices);
        let sum: f64 = self.deletion_weights(length).map(|(_, weight)| weight).sum();
        let keeps_an_end_alone = deletion.from_camera == 1 || deletion.from_light == 1;
        if ways == 0 || keeps_an_end_alone || (deletion.vertices == 0 && deletion.takes_an_end()) {
            return 0.0;
        }
        deletion_weight(deletion.vertices) / sum / f64::from(ways)
    }

    fn deletion_weights(&self, length: u32) -> impl Iterator<Item = (u32, f64)> {
        (0..=length + 1).map(move |vertices| {
            let possible = ways(length + 1 - vertices, vertices) > 0;
            (vertices, if possible { deletion_weight(vertices) } else { 0.0 })
        })
    }

    /// How many vertices can come for those that are taken out of a path with `length` edges; none where no number will do.
    #[must_use]
    pub fn growth(&self, length: u32, deletion: Deletion) -> Growth {
        let kept = length + 1 - deletion.vertices;
        let least = u32::from(deletion.takes_an_end() || deletion.vertices == 0);
        Growth {
            least: least.max((self.shortest + 1).saturating_sub(kept)),
            most: (self.longest + 1).saturating_sub(kept),
        }
    }
}

/// The numbers of vertices that can come for others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Growth {
    /// The fewest.
    pub least: u32,
    /// The most; where it is less than `least`, there is none.
    pub most: u32,
}

impl Growth {
    /// The number that comes for `taken`, as `u` in [0, 1) chooses.
    #[must_use]
    pub fn sample(&self, taken: u32, u: f64) -> u32 {
        let mut left = u * self.weights(taken).map(|(_, weight)| weight).sum::<f64>();
        for (number, weight) in self.weights(taken) {
            if left < weight {
                return number;
            }
            left -= weight;
        }
        self.most
    }

    /// The probability that `number` come for `taken`.
    #[must_use]
    pub fn probability(&self, taken: u32, number: u32) -> f64 {
        if !(self.least..=self.most).contains(&number) {
            return 0.0;
        }
        let sum: f64 = self.weights(taken).map(|(_, weight)| weight).sum();
        growth_weight(i64::from(number) - i64::from(taken)) / sum
    }

    fn weights(&self, taken: u32) -> impl Iterator<Item = (u32, f64)> {
        (self.least..=self.most).map(move |number| (number, growth_weight(i64::from(number) - i64::from(taken))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const REPLACEMENT: Replacement = Replacement {
        shortest: 3,
        longest: 9,
    };

    /// Every deletion from a path with `length` edges that has a probability.
    fn deletions(length: u32) -> Vec<Deletion> {
        let all = (0..=length + 1).flat_map(|vertices| {
            (0..=length + 1 - vertices).map(move |from_camera| Deletion {
                vertices,
                from_camera,
                from_light: length + 1 - vertices - from_camera,
            })
        });
        all.filter(|&deletion| REPLACEMENT.deletion(length, deletion) > 0.0)
            .collect()
    }

    #[test]
    fn deletions_have_the_probabilities_with_which_they_are_drawn() {
        const SIDE: u32 = 400;
        for length in 3..=9 {
            let mut counts = std::collections::BTreeMap::new();
            for (i, j) in (0..SIDE).flat_map(|i| (0..SIDE).map(move |j| (i, j))) {
                let place = |i: u32| (f64::from(i) + 0.5) / f64::from(SIDE);
                let Deletion {
                    vertices, from_camera, ..
                } = REPLACEMENT.delete(length, place(i), place(j));
                *counts.entry((vertices, from_camera)).or_insert(0_u32) += 1;
            }
            let mut sum = 0.0;
            for deletion in deletions(length) {
                let probability = REPLACEMENT.deletion(length, deletion);
                let count = counts.remove(&(deletion.vertices, deletion.from_camera)).unwrap_or(0);
                let drawn = f64::from(count) / f64::from(SIDE * SIDE);
                assert!(
                    (drawn - probability).abs() < 4e-3,
                    "{length} {deletion:?}: {drawn} {probability}"
                );
                assert!(deletion.from_camera != 1 && deletion.from_light != 1);
                assert!(deletion.vertices > 0 || !deletion.takes_an_end());
                sum += probability;
            }
            assert!((sum - 1.0).abs() < 1e-12, "{length}: {sum}");
            assert!(counts.is_empty(), "{length}: {counts:?} have no probability");
        }
    }

    #[test]
    fn insertions_have_the_probabilities_with_which_they_are_drawn_and_can_be_undone() {
        const DRAWS: u32 = 10_000;
        for length in 3..=9 {
            for deletion in deletions(length) {
                let mut counts = [0_u32; 16];
                let growth = REPLACEMENT.growth(length, deletion);
                if growth.least > growth.most {
                    // The longest path cannot grow, and one from which only an edge is taken has to.
                    assert_eq!((length, deletion.vertices), (9, 0));
                    continue;
                }
                for i in 0..DRAWS {
                    let u = (f64::from(i) + 0.5) / f64::from(DRAWS);
                    counts[growth.sample(deletion.vertices, u) as usize] += 1;
                }
                let total: u32 = counts.iter().sum();
                for (vertices, count) in (0..).zip(counts) {
                    let probability = growth.probability(deletion.vertices, vertices);
                    let drawn = f64::from(count) / f64::from(total.max(1));
                    assert!((drawn - probability).abs() < 2e-4, "{length} {deletion:?} {vertices}");
                    if probability > 0.0 {
                        let back = Deletion { vertices, ..deletion };
                        let longer = length + vertices - deletion.vertices;
                        assert!((3..=9).contains(&longer));
                        assert!(REPLACEMENT.deletion(longer, back) > 0.0, "{longer} {back:?}");
                        let there = REPLACEMENT.growth(longer, back);
                        assert!(
                            there.probability(vertices, deletion.vertices) > 0.0,
                            "{longer} {back:?}"
                        );
                    }
                }
            }
        }
    }
}
