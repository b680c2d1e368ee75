//! Cameras: rays against those computed with Mitsuba 3.9, from film to ray to film again, and what lenses focus on.

use crate::support::draws::stream;
use chainlight::camera::Camera;
use chainlight::sampling::{Stream, warp};
use chainlight::scene::{CameraDescription, FovAxis};
use glam::{DVec3, Vec2, Vec3};

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
        let camera = Camera::new(&description, width, height);
        let ray = camera.ray(Vec2::new(u * width as f32, v * height as f32), [0.5, 0.5]);
        let ours = ray.direction;
        assert!(
            (ours - Vec3::from_array(direction)).abs().max_element() < TOLERANCE,
            "{width}x{height} {fov_axis:?} ({u}, {v}): {ours}"
        );
        assert_eq!(ray.origin, Vec3::from_array(ORIGIN));
    }
}

const SIZE: (u32, u32) = (640, 360);

/// A camera of each model in turn, at some place, of some size, turned in some way. Its size: that of what it looks at.
fn random_camera(case: usize, stream: &mut Stream) -> (Camera, CameraDescription, f32) {
    let mut pick = |list: &[f32]| list[(stream.next_f32() * list.len() as f32) as usize];
    let size = pick(&[1e-3, 1.0, 1e4]);
    let far = pick(&[0.0, 1.0, 30.0]) * size;
    let fov = pick(&[0.5, 20.0, 90.0, 150.0]);
    let mut direction = || warp::uniform_sphere(stream.next_pair());
    let origin = direction() * far;
    let (view, up) = (direction(), direction().to_array());
    let (origin, target) = (origin.to_array(), (origin + view * size).to_array());
    let fov_axis = FovAxis::Larger;
    let description = match case % 3 {
        0 => CameraDescription::Perspective {
            origin,
            target,
            up,
            fov,
            fov_axis,
        },
        1 => CameraDescription::ThinLens {
            origin,
            target,
            up,
            fov,
            fov_axis,
            aperture_radius: 0.1 * size,
            focus_distance: case.is_multiple_of(2).then_some(1.7 * size),
        },
        _ => CameraDescription::Orthographic {
            origin,
            target,
            up,
            height: 0.5 * size,
        },
    };
    (Camera::new(&description, SIZE.0, SIZE.1), description, size)
}

/// A film position on the film, or up to 16 pixels beside it.
fn film_position(stream: &mut Stream) -> Vec2 {
    let beside = Vec2::splat(16.0);
    let size = Vec2::new(SIZE.0 as f32, SIZE.1 as f32);
    Vec2::from_array(stream.next_pair()) * (size + 2.0 * beside) - beside
}

/// Angles of view from half a degree to 150: a pixel is at least 1.3e-5 wide as the film is seen. In roundings of the
/// farthest coordinate over the distance from the camera.
#[test]
fn what_a_ray_meets_is_seen_where_the_ray_began() {
    let mut stream = stream(700);
    let mut worst = 0.0_f32;
    for case in 0..3000 {
        let (camera, description, size) = random_camera(case, &mut stream);
        for _ in 0..20 {
            let (film, lens) = (film_position(&mut stream), stream.next_pair());
            let ray = camera.ray(film, lens);
            assert!((ray.direction.length() - 1.0).abs() < 2e-7);
            assert_eq!(camera.lens_point(lens) == ray.origin, !camera.is_directional());
            let distance = size * (0.5 + stream.next_f32());
            let point = ray.origin + ray.direction * distance;
            let seen = camera.project(ray.origin, point).expect("in front of the camera");
            let roundings = (ray.origin.abs().max_element() + distance) / distance * f32::EPSILON;
            let pixel = match description {
                CameraDescription::Orthographic { height, .. } => height / SIZE.1 as f32 / distance,
                CameraDescription::Perspective { fov, .. } | CameraDescription::ThinLens { fov, .. } => {
                    2.0 * libm::tanf((0.5 * fov).to_radians()) / SIZE.0 as f32
                }
            };
            // Off the axis the film is farther away and seen aslant.
            let straight =
                camera.density(ray.direction) / camera.density(camera.ray(Vec2::new(320.0, 180.0), lens).direction);
            let off = (seen.film - film).length() * pixel / (roundings * straight.max(1.0));
            worst = worst.max(off);
            assert!(off < 4.0, "{description:?}: {film} seen at {} ({off})", seen.film);
            let there = (point.as_dvec3() - seen.origin.as_dvec3()).normalize();
            assert!(
                there.distance(seen.direction.as_dvec3()) < f64::from(4.0 * roundings),
                "{description:?}"
            );
            assert!(
                seen.origin.distance(ray.origin) <= 4.0 * roundings * distance,
                "{description:?}"
            );
            // What lies behind is not seen.
            let behind = ray.origin - ray.direction * distance;
            assert_eq!(camera.project(ray.origin, behind), None, "{description:?}");
        }
    }
    assert!(worst > 0.01, "{worst}");
}

#[test]
fn nothing_is_seen_that_has_no_film_position() {
    let mut stream = stream(701);
    for case in 0..300 {
        let (camera, ..) = random_camera(case, &mut stream);
        let ray = camera.ray(Vec2::new(320.0, 180.0), [0.5, 0.5]);
        for number in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            assert_eq!(camera.project(ray.origin, Vec3::new(number, 0.0, 1.0)), None);
        }
        if !camera.is_directional() {
            assert_eq!(camera.project(ray.origin, ray.origin), None);
            for direction in [ray.direction.any_orthonormal_vector(), -ray.direction] {
                let density = camera.density(direction);
                assert!(density >= 0.0 && density.is_finite());
            }
            assert_eq!(camera.density(-ray.direction), 0.0);
        }
    }
}

#[test]
fn all_rays_of_a_film_position_meet_on_the_focal_plane() {
    let (origin, target) = ([1.0, 2.0, 3.0], [0.5, 0.2, -1.0]);
    let (up, fov, fov_axis) = ([0.0, 1.0, 0.0], 50.0, FovAxis::Vertical);
    let pinhole = CameraDescription::Perspective {
        origin,
        target,
        up,
        fov,
        fov_axis,
    };
    let pinhole = Camera::new(&pinhole, SIZE.0, SIZE.1);
    let to_target = Vec3::from_array(target).distance(Vec3::from_array(origin));
    let mut stream = stream(702);
    for (aperture_radius, focus_distance) in [(1e-3, None), (0.2, None), (0.2, Some(0.3)), (1.0, Some(1e3))] {
        let description = CameraDescription::ThinLens {
            origin,
            target,
            up,
            fov,
            fov_axis,
            aperture_radius,
            focus_distance,
        };
        let camera = Camera::new(&description, SIZE.0, SIZE.1);
        let distance = focus_distance.unwrap_or(to_target);
        let forward = pinhole.ray(Vec2::new(320.0, 180.0), [0.5, 0.5]).direction.as_dvec3();
        for _ in 0..1000 {
            let (film, lens) = (film_position(&mut stream), stream.next_pair());
            let focused = |ray: chainlight::camera::CameraRay| {
                let from = ray.origin.as_dvec3() - Vec3::from_array(origin).as_dvec3();
                let along = ray.direction.as_dvec3();
                from + along * ((f64::from(distance) - from.dot(forward)) / along.dot(forward))
            };
            let sharp: DVec3 = focused(pinhole.ray(film, lens));
            let ray = camera.ray(film, lens);
            let off = focused(ray).distance(sharp) / sharp.length();
            assert!(off < 1e-6, "{description:?}: {off}");
            let radius = ray.origin.distance(Vec3::from_array(origin));
            assert!(radius <= aperture_radius * 1.000_01 + 1e-6, "{radius}");
        }
    }
}

#[test]
fn an_orthographic_camera_keeps_sizes_at_any_distance() {
    let description = CameraDescription::Orthographic {
        origin: [10.0, 20.0, 30.0],
        target: [10.0, 20.0, 0.0],
        up: [0.0, 1.0, 0.0],
        height: 4.5,
    };
    let camera = Camera::new(&description, SIZE.0, SIZE.1);
    assert!(camera.is_directional() && !camera.has_aperture());
    let corner = |x, y| camera.ray(Vec2::new(x, y), [0.1, 0.9]).origin;
    assert_eq!(corner(0.0, 0.0), Vec3::new(6.0, 22.25, 30.0));
    assert_eq!(corner(640.0, 360.0), Vec3::new(14.0, 17.75, 30.0));
    assert_eq!(camera.density(Vec3::NEG_Z), 1.0 / (8.0 * 4.5));
    for depth in [1e-3, 1.0, 29.0, 1e6] {
        let seen = camera
            .project(Vec3::ZERO, Vec3::new(6.0, 22.25, 30.0 - depth))
            .expect("before it");
        assert_eq!((seen.film, seen.direction), (Vec2::ZERO, Vec3::NEG_Z));
        assert_eq!(seen.origin, Vec3::new(6.0, 22.25, 30.0));
    }
    assert_eq!(camera.project(Vec3::ZERO, Vec3::new(10.0, 20.0, 30.5)), None);
}
