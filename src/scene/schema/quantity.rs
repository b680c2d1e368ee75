//! What the numbers and names of the format are, for its schema: bounds, units, counts. No value has one of these types;
//! descriptions name them (`#[schemars(with = "quantity::Length")]`) where Rust's own type says less.
//!
//! Units stand under the key [`UNIT`], which validators pass over.

use crate::light::TURBIDITY;
use crate::material::metals::METALS;
use crate::scene::description::{EXPOSURE, FORMAT_VERSION, MAX_DEPTH_LIMIT, MAX_FILM_SIDE};
use crate::scene::limits::{
    FILTER_RADIUS, FILTER_SIGMA, FOV_MARGIN, IOR, MAX_CONDUCTOR_INDEX, MAX_CUTOFF, MAX_RADIANCE, MAX_ROTATION,
    MAX_TEXTURE_SCALE, MAX_TURN, MIN_CUTOFF, MIN_HEIGHTS, MIN_LENS_LENGTH, SEGMENTS,
};
use crate::scene::mesh::MAX_COORDINATE;
use crate::tolerance::LEAST_ROUGHNESS;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde_json::Value;
use std::borrow::Cow;

/// The key of a number's unit.
pub const UNIT: &str = "x-unit";

const LENGTH: &str = "scene units";

macro_rules! quantities {
    ($($(#[$doc:meta])* $name:ident = $schema:expr;)*) => {$(
        $(#[$doc])*
        pub enum $name {}

        impl JsonSchema for $name {
            fn inline_schema() -> bool {
                true
            }

            fn schema_name() -> Cow<'static, str> {
                stringify!($name).into()
            }

            fn json_schema(_: &mut SchemaGenerator) -> Schema {
                $schema
            }
        }
    )*};
}

quantities! {
    /// A point, or the way from one to another.
    Position = array(3, number([-MAX_COORDINATE, MAX_COORDINATE], LENGTH));
    /// A direction.
    Direction = array(3, number([-MAX_COORDINATE, MAX_COORDINATE], "any length but zero"));
    /// One coordinate.
    Coordinate = number([-MAX_COORDINATE, MAX_COORDINATE], LENGTH);
    /// An extent of a shape.
    Length = json_schema!({"type": "number", "exclusiveMinimum": 0, "maximum": MAX_COORDINATE, UNIT: LENGTH});
    /// An extent of a camera.
    LensLength = number([MIN_LENS_LENGTH, MAX_COORDINATE], LENGTH);
    /// Rows of heights.
    Heights = json_schema!({
        "type": "array",
        "minItems": MIN_HEIGHTS,
        "items": {
            "type": "array",
            "minItems": MIN_HEIGHTS,
            "items": number([-MAX_COORDINATE, MAX_COORDINATE], ""),
        },
    });
    /// Factors along the three axes.
    ScaleFactors = array(3, number([-MAX_COORDINATE, MAX_COORDINATE], "not 0"));
    /// The rows of a matrix.
    Matrix = array(4, array(4, number([-MAX_COORDINATE, MAX_COORDINATE], "")));
    /// Pieces around an axis and around a tube.
    Segments = array(2, whole(SEGMENTS, ""));

    /// A full angle of view.
    AngleOfView = number([FOV_MARGIN, 180.0 - FOV_MARGIN], "degrees");
    /// The half angle of a cone.
    Cutoff = number([MIN_CUTOFF, MAX_CUTOFF], "degrees");
    /// The half angle of the bright part of a cone.
    Beam = number([0.0, MAX_CUTOFF], "degrees");
    /// By how much a picture is turned.
    Turn = number([-MAX_TURN, MAX_TURN], "degrees");
    /// By how much a shape is turned.
    Rotation = number([-MAX_ROTATION, MAX_ROTATION], "degrees");

    /// Power per solid angle.
    Intensity = array(3, number([0.0, MAX_RADIANCE], "W sr⁻¹ per channel"));
    /// Power per area.
    Irradiance = array(3, number([0.0, MAX_RADIANCE], "W m⁻² per channel"));
    /// Power per solid angle and area.
    Radiance = array(3, number([0.0, MAX_RADIANCE], "W sr⁻¹ m⁻² per channel"));
    /// A factor of light.
    Factor = number([0.0, MAX_RADIANCE], "");
    /// A share of light.
    Share = array(3, number([0.0, 1.0], "per channel"));
    /// Haze of the air.
    Turbidity = number(TURBIDITY, "");
    /// The index of refraction of a clear medium.
    RefractiveIndex = number(IOR, "");
    /// A part of a metal's index of refraction.
    ComplexIndex = array(3, number([0.0, MAX_CONDUCTOR_INDEX], "per channel"));
    /// The roughness of microfacets.
    Roughness = number([LEAST_ROUGHNESS, 1.0], "");
    /// A metal by its symbol.
    Metal = json_schema!({"type": "string", "enum": METALS.map(|metal| metal.symbol)});
    /// Repetitions per unit of two texture coordinates.
    Repeats = array(2, number([-MAX_TEXTURE_SCALE, MAX_TEXTURE_SCALE], ""));

    /// A side of the film.
    FilmSide = whole([1, MAX_FILM_SIDE], "pixels");
    /// The radius of a reconstruction filter.
    FilterRadius = number(FILTER_RADIUS, "pixels");
    /// The standard deviation of a reconstruction filter.
    FilterSigma = number(FILTER_SIGMA, "pixels");
    /// By how much a picture is shown brighter.
    Exposure = number(EXPOSURE, "stops");
    /// A number of edges.
    MaxDepth = whole([1, MAX_DEPTH_LIMIT], "edges");
    /// The version of the format.
    Version = json_schema!({"type": "integer", "const": FORMAT_VERSION});

    /// The name of something.
    Name = json_schema!({"type": "string", "minLength": 1});
    /// The name of a file.
    FileName = json_schema!({"type": "string", "minLength": 1});
}

/// What a name in a map must be.
pub fn not_empty() -> Value {
    serde_json::json!({"minLength": 1})
}

fn number([least, most]: [f32; 2], unit: &str) -> Schema {
    bounded("number", least.into(), most.into(), unit)
}

fn whole([least, most]: [u32; 2], unit: &str) -> Schema {
    bounded("integer", least.into(), most.into(), unit)
}

fn bounded(kind: &str, least: Value, most: Value, unit: &str) -> Schema {
    let mut schema = json_schema!({"type": kind, "minimum": least, "maximum": most});
    if !unit.is_empty() {
        schema.insert(UNIT.to_owned(), unit.into());
    }
    schema
}

fn array(count: usize, items: Schema) -> Schema {
    json_schema!({"type": "array", "items": items, "minItems": count, "maxItems": count})
}
