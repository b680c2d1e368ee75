//! What systems share that split light into layers: no table.

use crate::layer::{LayerFilms, Layers};
use bevy_ecs::resource::Resource;
use std::sync::Arc;

/// The layers.
#[derive(Resource, Clone)]
pub struct LayersRef(pub Arc<Layers>);

/// The films of layers.
#[derive(Resource, Clone)]
pub struct LayerFilmsRef {
    /// The films. Steps of independent samples take turns among their groups.
    pub films: Arc<LayerFilms>,
    /// What light is multiplied with on its way to all of them: of independent samples, the inverse of the films' unit.
    pub scale: f32,
    /// What it is multiplied with, beside, on its way to pixels: of chains, how much their group counts.
    pub weight: f32,
}

impl LayerFilmsRef {
    /// The group that a step of independent samples counts for.
    #[must_use]
    pub fn turn(&self, step: u64) -> usize {
        (step % self.films.groups().max(1) as u64) as usize
    }
}

/// The work of independent samples by layers, in edges that were traced.
#[derive(Resource, Clone, Debug, Default, PartialEq)]
pub struct LayerWork {
    /// By layer.
    pub edges: Vec<f64>,
    /// Edges of samples that tried no path to a light.
    pub nowhere: f64,
}

impl LayerWork {
    /// Books a sample that traced so many edges, and tried paths that have so many edges together in each layer. The work belongs to what
    /// was tried with it, in proportion to edges.
    pub fn book(&mut self, traced: f64, tried: &[f64]) {
        self.edges.resize(self.edges.len().max(tried.len()), 0.0);
        let all: f64 = tried.iter().sum();
        if all <= 0.0 {
            self.nowhere += traced;
            return;
        }
        for (sum, tried) in self.edges.iter_mut().zip(tried) {
            *sum += traced * tried / all;
        }
    }

    /// Adds the work of another world.
    pub fn add(&mut self, other: &Self) {
        self.edges.resize(self.edges.len().max(other.edges.len()), 0.0);
        self.edges
            .iter_mut()
            .zip(&other.edges)
            .for_each(|(sum, more)| *sum += more);
        self.nowhere += other.nowhere;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_belongs_to_what_was_tried_with_it() {
        let mut work = LayerWork::default();
        work.book(6.0, &[1.0, 0.0, 2.0]);
        work.book(3.0, &[0.0, 0.0, 0.0]);
        let mut sum = LayerWork::default();
        sum.book(1.0, &[0.0, 1.0, 0.0]);
        sum.add(&work);
        assert_eq!((sum.edges, sum.nowhere), (vec![2.0, 1.0, 4.0], 3.0));
    }
}
