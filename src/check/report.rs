//! What a check found.

use serde::Serialize;
use std::fmt;

/// Kinds of tests.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum TestKind {
    /// Weighted states stay distributed as the target; the last decision by expectation.
    Target,
    /// Decisions are taken as often as acceptances say.
    Decided,
    /// As much goes from one cell to another as comes back.
    Flow,
    /// Proposals weighted by 1/T spread over the support as known draws do.
    Density,
    /// Proposals weighted by 1/T are uniform in uniform coordinates.
    Uniform,
    /// Proposals are where they can be.
    Support,
}

impl TestKind {
    /// All of them.
    pub const ALL: [Self; 6] = [
        Self::Target,
        Self::Decided,
        Self::Flow,
        Self::Density,
        Self::Uniform,
        Self::Support,
    ];

    /// Its name in reports.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Target => "target",
            Self::Decided => "decided",
            Self::Flow => "flow",
            Self::Density => "density",
            Self::Uniform => "uniform",
            Self::Support => "support",
        }
    }
}

/// A state, to be looked at.
#[derive(Clone, Debug, Serialize)]
pub struct State {
    /// Edges of the path that carries most of its light.
    pub length: u32,
    /// Kinds of vertices of that path.
    pub signature: String,
    /// f.
    pub target: f32,
    /// Where on the film it starts, in shares of its width and height; none where states do not say.
    pub film: Option<[f64; 2]>,
}

/// A replica that shows what a test found: the one that weighs most in the direction of the deviation.
#[derive(Clone, Debug, Serialize)]
pub struct Witness {
    /// Global number of the chain.
    pub chain: u32,
    /// Round of the bootstrap that its first state is from.
    pub round: u64,
    /// Seed of all random numbers.
    pub seed: u64,
    /// The number of its last step, counted from 0.
    pub step: u64,
    /// w = f(x₀)/p(x₀).
    pub weight: f64,
    /// x₀.
    pub start: State,
    /// The proposal of the last step.
    pub proposal: State,
    /// With what probability it was taken.
    pub acceptance: f64,
}

/// One test and its outcome.
#[derive(Clone, Debug, Serialize)]
pub struct TestOutcome {
    /// Which kind.
    pub kind: TestKind,
    /// What chains did: this mutation alone, or mixed with another.
    pub run: String,
    /// Steps that replicas took.
    pub steps: u64,
    /// The cell, or the pair of cells.
    pub name: String,
    /// The mean that should be zero.
    pub mean: f64,
    /// Its standard error.
    pub error: f64,
    /// The mean in standard errors, corrected for skewness.
    pub z: f64,
    /// The probability of a deviation at least this large when nothing is wrong.
    pub p: f64,
    /// The mean beside what it is a part of: a relative bias.
    pub bias: f64,
    /// The smallest relative bias that would have shown with a probability of 95 %.
    pub sees: f64,
    /// Whether it passed.
    pub passed: bool,
    /// A replica that shows it, for the clearest failures of a kind.
    pub witness: Option<Witness>,
}

/// Whether the density could be tested.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Tested {
    /// Over a region about the state.
    Region {
        /// Cells that were judged.
        judged: usize,
        /// Cells that anything was in: in those that were not judged, too few known draws were for their sums to be near
        /// normal, and this says nothing of them.
        cells: usize,
        /// The smallest relative error that a cell would have shown with a probability of 95 %; none where none was judged.
        sees: Option<f64>,
    },
    /// Over the whole space.
    Space,
    /// A point mass has none: proposals were compared with the state, bit for bit.
    PointMass,
    /// The mutation gives no support.
    NoSupport,
}

impl fmt::Display for Tested {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Region {
                judged,
                cells,
                sees: Some(sees),
            } => {
                let (rare, sees) = (cells - judged, 100.0 * sees);
                write!(
                    f,
                    "tested over its region in {judged} cells, the least visible error {sees:.2} %; "
                )?;
                write!(
                    f,
                    "NOT TESTED in {rare} that too few known draws are in for normal sums"
                )
            }
            Self::Region { cells, .. } => {
                write!(
                    f,
                    "NOT TESTED: in none of {cells} cells are enough known draws for normal sums"
                )
            }
            Self::Space => f.write_str("tested over the whole space"),
            Self::PointMass => f.write_str("none, a point mass: proposals were compared with the state, bit for bit"),
            Self::NoSupport => f.write_str("NOT TESTED: it gives no support"),
        }
    }
}

/// What the check of one mutation found.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// The mutation.
    pub mutation: &'static str,
    /// Its settings.
    pub settings: serde_json::Value,
    /// Seed of all random numbers.
    pub seed: u64,
    /// The probability that any test fails when nothing is wrong.
    pub significance: f64,
    /// Replicas of the target and flow tests.
    pub replicas: u64,
    /// Steps after which their states were looked at.
    pub steps: Vec<u64>,
    /// Proposals that the density was tested with.
    pub density_replicas: u64,
    /// Whether the density could be tested.
    pub density: Tested,
    /// All tests.
    pub tests: Vec<TestOutcome>,
    /// Tests that too few replicas had anything to do with to be judged.
    pub untested: usize,
    /// Proposals from states with light.
    pub proposals: u64,
    /// Those among them that could not have been taken.
    pub failed_proposals: u64,
    /// Wall time in seconds.
    pub seconds: f64,
}

/// Proposals from states with light below which nothing can be said of a mutation.
const LEAST_PROPOSALS: u64 = 1024;

/// The failures of a report by kind.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Failures(pub Vec<(TestKind, usize)>);

impl Report {
    /// Whether every test passed, and there was enough to judge by.
    #[must_use]
    pub fn passed(&self) -> bool {
        !self.is_undecided() && self.tests.iter().all(|test| test.passed)
    }

    /// Whether too few replicas had any light for a verdict.
    #[must_use]
    pub const fn is_undecided(&self) -> bool {
        self.proposals < LEAST_PROPOSALS
    }

    /// The tests of a kind.
    pub fn of_kind(&self, kind: TestKind) -> impl Iterator<Item = &TestOutcome> {
        self.tests.iter().filter(move |test| test.kind == kind)
    }

    /// How many tests of each kind failed; kinds without failures are left out.
    #[must_use]
    pub fn failures(&self) -> Failures {
        let count = |kind| self.of_kind(kind).filter(|test| !test.passed).count();
        let counts = TestKind::ALL.map(|kind| (kind, count(kind)));
        Failures(counts.into_iter().filter(|(_, count)| *count > 0).collect())
    }

    /// The clearest failure of a kind.
    #[must_use]
    pub fn clearest(&self, kind: TestKind) -> Option<&TestOutcome> {
        let failures = self.of_kind(kind).filter(|test| !test.passed);
        failures.max_by(|a, b| a.z.abs().total_cmp(&b.z.abs()))
    }

    /// The share of proposals that could not have been taken.
    #[must_use]
    pub fn failed_share(&self) -> f64 {
        self.failed_proposals as f64 / self.proposals.max(1) as f64
    }
}

impl fmt::Display for State {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} of length {}, f = {:.4e}",
            self.signature, self.length, self.target
        )?;
        match self.film {
            Some([x, y]) => write!(f, ", film ({x:.5}, {y:.5})"),
            None => Ok(()),
        }
    }
}

impl fmt::Display for Witness {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "chain {}, round {}, seed {}, step {}, weight {:.4e}",
            self.chain, self.round, self.seed, self.step, self.weight
        )?;
        writeln!(f, "        from {}", self.start)?;
        write!(f, "        to   {}, taken with {:.4}", self.proposal, self.acceptance)
    }
}

impl fmt::Display for TestOutcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} of {}, {} steps, {}: {:+.2} % (sees {:.2} %), z {:+.1}",
            self.kind.name(),
            self.name,
            self.steps,
            self.run,
            100.0 * self.bias,
            100.0 * self.sees,
            self.z
        )
    }
}

/// Failures of a kind that are written out.
pub(super) const SHOWN: usize = 3;

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let verdict = match (self.passed(), self.is_undecided()) {
            (true, _) => "passed",
            (false, true) => "UNDECIDED, too few replicas have any light",
            (false, false) => "FAILED",
        };
        writeln!(
            f,
            "{}: {verdict}; {} tests at {:.2} % in all, {} replicas, {:.1} s",
            self.mutation,
            self.tests.len(),
            100.0 * self.significance,
            self.replicas,
            self.seconds
        )?;
        for kind in TestKind::ALL {
            self.write_kind(f, kind)?;
        }
        writeln!(f, "  density: {}", self.density)?;
        if self.untested > 0 {
            writeln!(
                f,
                "  not judged: {} cells or pairs that too few replicas reached",
                self.untested
            )?;
        }
        write!(
            f,
            "  failed proposals: {:.2} % of {}",
            100.0 * self.failed_share(),
            self.proposals
        )
    }
}

impl Report {
    fn write_kind(&self, f: &mut fmt::Formatter<'_>, kind: TestKind) -> fmt::Result {
        let count = self.of_kind(kind).count();
        if count == 0 {
            return Ok(());
        }
        // Where nothing changes, any change would show.
        let mut sees: Vec<f64> = self
            .of_kind(kind)
            .map(|test| test.sees)
            .filter(|sees| *sees > 0.0)
            .collect();
        sees.sort_unstable_by(f64::total_cmp);
        let mut failed: Vec<&TestOutcome> = self.of_kind(kind).filter(|test| !test.passed).collect();
        failed.sort_unstable_by(|a, b| b.z.abs().total_cmp(&a.z.abs()));
        let largest = self.of_kind(kind).map(|test| test.z.abs()).fold(0.0, f64::max);
        write!(
            f,
            "  {:<8} {count:>5} tests, {:>4} failed, largest |z| {largest:.1}; ",
            kind.name(),
            failed.len(),
        )?;
        match (sees.first(), sees.get(sees.len() / 2)) {
            (Some(best), Some(half)) => writeln!(
                f,
                "sees biases of {:.2} % at best, {:.2} % in half of them",
                100.0 * best,
                100.0 * half
            )?,
            _ => writeln!(f, "nothing changed, and any change would show")?,
        }
        for test in failed.iter().take(SHOWN) {
            writeln!(f, "    {test}")?;
            if let Some(witness) = &test.witness {
                writeln!(f, "      {witness}")?;
            }
        }
        Ok(())
    }
}
