//! The perspective camera against rays computed with Mitsuba 3.9.

use chainlight::camera::Perspective;
use chainlight::scene::{CameraDescription, FovAxis};
use glam::{Vec2, Vec3};

const TOLERANCE: f32 = 2e-6;
const ORIGIN: [f32; 3] = [1.0, 2.0, 3.0];

/// ((width, height), axis of the 40 degrees, (u, v) over the film from its top left, direction).
type Ray = ((u32, u32), FovAxis, (f32, f32), [f32; 3]);

const RAYS: [Ray; 16] = [
    (
        (400, 300),
        FovAxis::Horizontal,
        (0.5, 0.5),
        [-0.113_257, -0.407_724, -0.906_054],
    ),
    (
        (400, 300),
        FovAxis::Horizontal,
        (0.0, 0.0),
        [-0.444_391, -0.144_240, -0.884_145],
    ),
    (
        (400, 300),
        FovAxis::Horizontal,
        (1.0, 0.0),
        [0.213_081, -0.144_240, -0.966_329],
    ),
    (
        (400, 300),
        FovAxis::Horizontal,
        (0.25, 0.75),
        [-0.279_786, -0.519_091, -0.807_628],
    ),
    (
        (400, 300),
        FovAxis::Vertical,
        (0.0, 0.0),
        [-0.524_286, -0.064_450, -0.849_100],
    ),
    (
        (400, 300),
        FovAxis::Vertical,
        (1.0, 0.0),
        [0.299_145, -0.064_450, -0.952_029],
    ),
    (
        (400, 300),
        FovAxis::Vertical,
        (0.25, 0.75),
        [-0.329_982, -0.549_190, -0.767_791],
    ),
    (
        (300, 400),
        FovAxis::Horizontal,
        (0.0, 0.0),
        [-0.426_603, 0.030_266, -0.903_932],
    ),
    (
        (300, 400),
        FovAxis::Horizontal,
        (0.0, 1.0),
        [-0.384_636, -0.727_464, -0.568_199],
    ),
    (
        (300, 400),
        FovAxis::Horizontal,
        (0.25, 0.75),
        [-0.269_444, -0.602_196, -0.751_505],
    ),
    (
        (300, 400),
        FovAxis::Vertical,
        (0.0, 1.0),
        [-0.332_887, -0.673_627, -0.659_859],
    ),
    (
        (300, 400),
        FovAxis::Vertical,
        (0.25, 0.75),
        [-0.233_522, -0.559_599, -0.795_183],
    ),
    (
        (400, 300),
        FovAxis::Smaller,
        (0.0, 1.0),
        [-0.492_811, -0.632_748, -0.597_300],
    ),
    (
        (300, 400),
        FovAxis::Smaller,
        (0.0, 1.0),
        [-0.384_636, -0.727_464, -0.568_199],
    ),
    (
        (400, 300),
        FovAxis::Larger,
        (0.0, 1.0),
        [-0.419_259, -0.598_000, -0.683_094],
    ),
    (
        (300, 400),
        FovAxis::Larger,
        (0.0, 1.0),
        [-0.332_887, -0.673_627, -0.659_859],
    ),
];

#[test]
fn directions_agree_with_reference_rays() {
    for ((width, height), fov_axis, (u, v), direction) in RAYS {
        let description = CameraDescription::Perspective {
            origin: ORIGIN,
            target: [0.5, 0.2, -1.0],
            up: [0.0, 1.0, 0.0],
            fov: 40.0,
            fov_axis,
        };
        let camera = Perspective::new(&description, width, height);
        let ours = camera.direction(Vec2::new(u * width as f32, v * height as f32));
        assert!(
            (ours - Vec3::from_array(direction)).abs().max_element() < TOLERANCE,
            "{width}x{height} {fov_axis:?} ({u}, {v}): {ours}"
        );
        assert_eq!(camera.origin(), Vec3::from_array(ORIGIN));
    }
}
