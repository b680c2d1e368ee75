//! Lane groups: sixteen values of one scalar side by side, and how structured values spread over several of them.

use crate::color::Rgb;
use bytemuck::{Pod, Zeroable};
use glam::{DVec2, Vec2, Vec3};

/// Chains (or rays) in one row of a table.
pub const LANES: usize = 16;

/// Rows that hold `count` chains: `count / 16`, rounded up.
#[must_use]
pub const fn lane_groups(count: usize) -> usize {
    count.div_ceil(LANES)
}

macro_rules! lane_array {
    ($(#[$doc:meta])* $name:ident, $scalar:ty) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
        #[repr(C, align(64))]
        pub struct $name(pub [$scalar; LANES]);

        impl LaneValue for $scalar {
            type Store = $name;
            #[inline]
            fn load(store: &$name, lane: usize) -> Self {
                store.0[lane % LANES]
            }
            #[inline]
            fn store(store: &mut $name, lane: usize, value: Self) {
                store.0[lane % LANES] = value;
            }
        }
    };
}

/// A value that a column can hold: it knows how sixteen of it are laid out, each scalar in lanes of its own.
pub trait LaneValue: Copy + 'static {
    /// Sixteen values side by side.
    type Store: Pod + Send + Sync;
    /// The value in `lane` (taken modulo [`LANES`]).
    fn load(store: &Self::Store, lane: usize) -> Self;
    /// Writes `value` to `lane` (taken modulo [`LANES`]).
    fn store(store: &mut Self::Store, lane: usize, value: Self);
}

lane_array!(
    /// Sixteen `f32`.
    LanesF32,
    f32
);
lane_array!(
    /// Sixteen `u32`.
    LanesU32,
    u32
);
lane_array!(
    /// Sixteen `u64`.
    LanesU64,
    u64
);

lane_array!(
    /// Sixteen `f64`.
    LanesF64,
    f64
);

/// Sixteen triples of `f32`, component by component.
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[repr(C, align(64))]
pub struct Lanes3(pub [LanesF32; 3]);

/// Sixteen pairs of `f64`, component by component.
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[repr(C, align(64))]
pub struct LanesD2(pub [LanesF64; 2]);

/// Sixteen pairs of `u32`, component by component.
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[repr(C, align(64))]
pub struct LanesU2(pub [LanesU32; 2]);

impl LaneValue for [u32; 2] {
    type Store = LanesU2;
    #[inline]
    fn load(store: &LanesU2, lane: usize) -> Self {
        let l = lane % LANES;
        [store.0[0].0[l], store.0[1].0[l]]
    }
    #[inline]
    fn store(store: &mut LanesU2, lane: usize, value: Self) {
        let l = lane % LANES;
        store.0[0].0[l] = value[0];
        store.0[1].0[l] = value[1];
    }
}

/// Sixteen pairs of `u64`, component by component.
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[repr(C, align(64))]
pub struct LanesUL2(pub [LanesU64; 2]);

impl LaneValue for [u64; 2] {
    type Store = LanesUL2;
    #[inline]
    fn load(store: &LanesUL2, lane: usize) -> Self {
        let l = lane % LANES;
        [store.0[0].0[l], store.0[1].0[l]]
    }
    #[inline]
    fn store(store: &mut LanesUL2, lane: usize, value: Self) {
        let l = lane % LANES;
        store.0[0].0[l] = value[0];
        store.0[1].0[l] = value[1];
    }
}

/// Sixteen pairs of `f32`, component by component.
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[repr(C, align(64))]
pub struct Lanes2(pub [LanesF32; 2]);

impl LaneValue for Vec2 {
    type Store = Lanes2;
    #[inline]
    fn load(store: &Lanes2, lane: usize) -> Self {
        let l = lane % LANES;
        Self::new(store.0[0].0[l], store.0[1].0[l])
    }
    #[inline]
    fn store(store: &mut Lanes2, lane: usize, value: Self) {
        let l = lane % LANES;
        store.0[0].0[l] = value.x;
        store.0[1].0[l] = value.y;
    }
}

impl LaneValue for Vec3 {
    type Store = Lanes3;
    #[inline]
    fn load(store: &Lanes3, lane: usize) -> Self {
        let l = lane % LANES;
        Self::new(store.0[0].0[l], store.0[1].0[l], store.0[2].0[l])
    }
    #[inline]
    fn store(store: &mut Lanes3, lane: usize, value: Self) {
        let l = lane % LANES;
        store.0[0].0[l] = value.x;
        store.0[1].0[l] = value.y;
        store.0[2].0[l] = value.z;
    }
}

impl LaneValue for Rgb {
    type Store = Lanes3;
    #[inline]
    fn load(store: &Lanes3, lane: usize) -> Self {
        let l = lane % LANES;
        Self::new(store.0[0].0[l], store.0[1].0[l], store.0[2].0[l])
    }
    #[inline]
    fn store(store: &mut Lanes3, lane: usize, value: Self) {
        let l = lane % LANES;
        store.0[0].0[l] = value.r;
        store.0[1].0[l] = value.g;
        store.0[2].0[l] = value.b;
    }
}

impl LaneValue for DVec2 {
    type Store = LanesD2;
    #[inline]
    fn load(store: &LanesD2, lane: usize) -> Self {
        let l = lane % LANES;
        Self::new(store.0[0].0[l], store.0[1].0[l])
    }
    #[inline]
    fn store(store: &mut LanesD2, lane: usize, value: Self) {
        let l = lane % LANES;
        store.0[0].0[l] = value.x;
        store.0[1].0[l] = value.y;
    }
}
