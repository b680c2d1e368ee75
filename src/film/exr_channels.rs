//! Channels of an OpenEXR layer, found by name and laid over the display window.

use crate::color::Rgb;
use exr::prelude::{AnyChannel, AnyChannels, FlatSamples, Layer, Text, Vec2};

pub type FlatLayer = Layer<AnyChannels<FlatSamples>>;
pub type Channel = AnyChannel<FlatSamples>;

/// The channels a layer's colours come from.
pub enum Color<'a> {
    Rgb([&'a Channel; 3]),
    Luminance(&'a Channel),
}

impl<'a> Color<'a> {
    pub fn of(layer: &'a FlatLayer) -> Option<Self> {
        let named = |name| channel_named(layer, name);
        match (named("R"), named("G"), named("B")) {
            (Some(r), Some(g), Some(b)) => Some(Self::Rgb([r, g, b])),
            _ => named("Y").map(Self::Luminance),
        }
    }
}

pub fn channel_named<'a>(layer: &'a FlatLayer, name: &str) -> Option<&'a Channel> {
    layer
        .channel_data
        .list
        .iter()
        .find(|c| c.name.as_slice() == name.as_bytes())
}

pub fn missing_colors(layers: &[FlatLayer]) -> String {
    let names: Vec<String> = layers
        .iter()
        .flat_map(|l| l.channel_data.list.iter().map(|c| string(&c.name)))
        .collect();
    format!("it has neither channels R, G and B nor Y, but {}", names.join(", "))
}

pub fn string(text: &Text) -> String {
    String::from_utf8_lossy(text.as_slice()).into_owned()
}

pub fn interleave([r, g, b]: [Vec<f32>; 3]) -> Vec<Rgb> {
    r.into_iter()
        .zip(g)
        .zip(b)
        .map(|((r, g), b)| Rgb::new(r, g, b))
        .collect()
}

/// The display window: what a viewer frames.
pub struct Window {
    pub x: i32,
    pub y: i32,
    pub width: usize,
    pub height: usize,
}

impl Window {
    /// A channel's samples over the window: zero where the layer has none.
    pub fn plane(&self, layer: &FlatLayer, channel: &Channel) -> Result<Vec<f32>, String> {
        if channel.sampling != Vec2(1, 1) {
            return Err(format!("its channel {} is subsampled", string(&channel.name)));
        }
        let mut out = vec![0.0; self.width * self.height];
        let position = layer.attributes.layer_position;
        let (dx, dy) = (
            i64::from(position.0) - i64::from(self.x),
            i64::from(position.1) - i64::from(self.y),
        );
        let inside = |origin: i64, i: usize, size: usize| {
            usize::try_from(origin + i as i64).ok().filter(|&target| target < size)
        };
        for row in 0..layer.size.1 {
            let Some(y) = inside(dy, row, self.height) else {
                continue;
            };
            for column in 0..layer.size.0 {
                let Some(x) = inside(dx, column, self.width) else {
                    continue;
                };
                let i = row * layer.size.0 + column;
                let sample = match &channel.sample_data {
                    FlatSamples::F16(v) => v.get(i).map(|h| h.to_f32()),
                    FlatSamples::F32(v) => v.get(i).copied(),
                    FlatSamples::U32(v) => v.get(i).map(|&u| u as f32),
                };
                out[y * self.width + x] = sample.ok_or("it holds fewer samples than its size says")?;
            }
        }
        Ok(out)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use exr::prelude::{Encoding, LayerAttributes};

    #[test]
    fn channels_that_skip_samples_or_miss_some_are_refused() {
        let window = Window {
            x: 0,
            y: 0,
            width: 2,
            height: 2,
        };
        let channel = AnyChannel::new("Y", FlatSamples::F32(vec![1.0]));
        let list = AnyChannels::sort([channel].into_iter().collect());
        let mut layer = Layer::new((2, 2), LayerAttributes::default(), Encoding::UNCOMPRESSED, list);
        let error = window
            .plane(&layer, &layer.channel_data.list[0])
            .expect_err("one sample of four");
        assert!(error.contains("fewer samples"), "{error}");
        layer.channel_data.list[0].sampling = Vec2(2, 2);
        let error = window
            .plane(&layer, &layer.channel_data.list[0])
            .expect_err("subsampled");
        assert!(error.contains("channel Y is subsampled"), "{error}");
    }
}
