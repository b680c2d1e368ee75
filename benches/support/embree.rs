//! Embree 4 through its shared library, to measure against: triangles in, hits out.
#![expect(unsafe_code, reason = "a library of another language")]

use glam::Vec3;
use libloading::Library;
use std::ffi::{c_char, c_void};
use std::path::Path;
use std::time::{Duration, Instant};

/// A ray as Embree takes it, four numbers a row, and room for the hit: `RTCRayHit`, and more than any version's hit takes.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
pub struct EmbreeRay {
    /// Origin and least distance.
    origin: [f32; 4],
    /// Direction and time.
    direction: [f32; 4],
    /// Largest distance, mask, number, flags.
    rest: [u32; 4],
    /// Normal, u.
    normal: [f32; 4],
    /// v, primitive, geometry, instance.
    names: [u32; 4],
    more: [u32; 12],
}

impl EmbreeRay {
    /// A ray that ends at `far`, in units of the direction's length.
    pub fn new(origin: Vec3, direction: Vec3, far: f32) -> Self {
        Self {
            origin: [origin.x, origin.y, origin.z, 0.0],
            direction: [direction.x, direction.y, direction.z, 0.0],
            rest: [far.to_bits(), u32::MAX, 0, 0],
            normal: [0.0; 4],
            names: [u32::MAX; 4],
            more: [u32::MAX; 12],
        }
    }

    /// The distance of the hit, or where it ends; below zero where anything was in its way.
    pub fn distance(&self) -> f32 {
        f32::from_bits(self.rest[0])
    }
}

type Object = *mut c_void;

/// A scene of triangles.
pub struct Embree {
    scene: Object,
    intersect: unsafe extern "C" fn(Object, *mut EmbreeRay, *const c_void),
    occluded: unsafe extern "C" fn(Object, *mut EmbreeRay, *const c_void),
    /// How long it took to build.
    pub build_time: Duration,
    _library: Library,
}

// SAFETY: a committed scene is only read by the functions called below, and Embree allows that from any thread.
unsafe impl Sync for Embree {}

const BUFFER_INDEX: u32 = 0;
const BUFFER_VERTEX: u32 = 1;
const FORMAT_UINT3: u32 = 0x5003;
const FORMAT_FLOAT3: u32 = 0x9003;
const GEOMETRY_TRIANGLE: u32 = 0;
const BUILD_QUALITY_MEDIUM: u32 = 1;

impl Embree {
    /// Builds a scene by the library at `path`, on one thread.
    pub fn build(path: &Path, triangles: &[[Vec3; 3]]) -> Result<Self, libloading::Error> {
        // SAFETY: the caller names Embree's library; its functions have the types of its header, rtcore.h of version 4. What is
        // created here lives as long as the process, and buffers are Embree's own, filled up to the sizes that it was asked for.
        unsafe {
            let library = Library::new(path)?;
            let new_device = library.get::<unsafe extern "C" fn(*const c_char) -> Object>(b"rtcNewDevice")?;
            let new_scene = library.get::<unsafe extern "C" fn(Object) -> Object>(b"rtcNewScene")?;
            let quality = library.get::<unsafe extern "C" fn(Object, u32)>(b"rtcSetSceneBuildQuality")?;
            let new_geometry = library.get::<unsafe extern "C" fn(Object, u32) -> Object>(b"rtcNewGeometry")?;
            let buffer = library.get::<unsafe extern "C" fn(Object, u32, u32, u32, usize, usize) -> *mut c_void>(
                b"rtcSetNewGeometryBuffer",
            )?;
            let commit_geometry = library.get::<unsafe extern "C" fn(Object)>(b"rtcCommitGeometry")?;
            let attach = library.get::<unsafe extern "C" fn(Object, Object) -> u32>(b"rtcAttachGeometry")?;
            let commit = library.get::<unsafe extern "C" fn(Object)>(b"rtcCommitScene")?;
            let intersect = *library.get(b"rtcIntersect1")?;
            let occluded = *library.get(b"rtcOccluded1")?;
            let device = new_device(c"threads=1".as_ptr());
            let geometry = new_geometry(device, GEOMETRY_TRIANGLE);
            let corners = 3 * triangles.len();
            let vertices = buffer(geometry, BUFFER_VERTEX, 0, FORMAT_FLOAT3, 12, corners).cast::<[f32; 3]>();
            for (number, corner) in triangles.iter().flatten().enumerate() {
                vertices.add(number).write(corner.to_array());
            }
            let indices = buffer(geometry, BUFFER_INDEX, 0, FORMAT_UINT3, 12, triangles.len()).cast::<[u32; 3]>();
            for number in 0..triangles.len() {
                let first = 3 * number as u32;
                indices.add(number).write([first, first + 1, first + 2]);
            }
            commit_geometry(geometry);
            let scene = new_scene(device);
            quality(scene, BUILD_QUALITY_MEDIUM);
            attach(scene, geometry);
            let began = Instant::now();
            commit(scene);
            Ok(Self {
                scene,
                intersect,
                occluded,
                build_time: began.elapsed(),
                _library: library,
            })
        }
    }

    /// Finds the closest hit of a ray.
    #[inline]
    pub fn closest_hit(&self, ray: &mut EmbreeRay) {
        // SAFETY: the scene is committed, the ray aligned and as large as the library's; no arguments are the defaults.
        unsafe { (self.intersect)(self.scene, ray, std::ptr::null()) }
    }

    /// Finds out whether anything is in the ray's way.
    #[inline]
    pub fn blocked(&self, ray: &mut EmbreeRay) {
        // SAFETY: as above; of a shadow ray only the ray is written.
        unsafe { (self.occluded)(self.scene, ray, std::ptr::null()) }
    }
}
