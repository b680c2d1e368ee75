//! Replicas run again, alone, to be looked at: their random numbers are named by the chain, so they do the same.

use super::CheckError;
use super::family::Side;
use super::replicas::{Replicas, Subject};
use super::report::{State, Witness};
use crate::chain::{Class, ProposedClass, StateClass, to_f64};
use crate::path::{ChainTable, PrimaryFilm, ProposedFilm};

/// Runs replica `chain` of `subject` again for `steps` steps.
pub(super) fn witness(subject: &Subject, chain: u32, seed: u64, steps: u64) -> Result<Witness, CheckError> {
    let mut replicas = subject.replicas()?;
    let weight = replicas.draw(chain, 1)[0];
    replicas.take();
    let start = look(&mut replicas, Side::Current);
    (0..steps).for_each(|step| replicas.step(step));
    Ok(Witness {
        chain,
        round: 0,
        seed,
        step: steps.saturating_sub(1),
        weight,
        start,
        proposal: look(&mut replicas, Side::Proposed),
        acceptance: replicas.acceptances()[0],
    })
}

fn look(replicas: &mut Replicas<'_>, side: Side) -> State {
    let (mut class, mut film) = ([0], [[u64::MAX; 2]]);
    let world = &mut replicas.world;
    match side {
        Side::Current => {
            world.read::<Class, ChainTable>(&mut class);
            world.read::<PrimaryFilm, ChainTable>(&mut film);
        }
        Side::Proposed => {
            world.read::<ProposedClass, ChainTable>(&mut class);
            world.read::<ProposedFilm, ChainTable>(&mut film);
        }
    }
    let class = StateClass(class[0]);
    State {
        length: class.length(),
        signature: class.signature().name(),
        target: replicas.targets(side)[0],
        film: (film[0] != [u64::MAX; 2]).then(|| film[0].map(to_f64)),
    }
}
