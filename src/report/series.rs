//! What all plots draw alike: a way's line, and the names of all.

use super::{FONT, PlotError, color};
use plotters::coord::ranged1d::Ranged;
use plotters::prelude::*;

/// A plot under way.
type Chart<'a, X, Y> = ChartContext<'a, SVGBackend<'a>, Cartesian2d<X, Y>>;

/// Draws the line of way number `way` through `points`, each of which is marked.
pub(super) fn line<'a, X, Y>(
    chart: &mut Chart<'a, X, Y>,
    (way, name): (usize, &str),
    points: Vec<(f64, f64)>,
) -> Result<(), PlotError>
where
    X: Ranged<ValueType = f64>,
    Y: Ranged<ValueType = f64>,
{
    let color = color(way);
    chart
        .draw_series([PathElement::new(points.clone(), color.stroke_width(2))])?
        .label(name)
        .legend(move |(x, y)| PathElement::new([(x, y), (x + 20, y)], color.stroke_width(3)));
    chart.draw_series(points.into_iter().map(|point| Circle::new(point, 3, color.filled())))?;
    Ok(())
}

/// Draws which line is whose.
pub(super) fn legend<'a, X, Y>(chart: &mut Chart<'a, X, Y>) -> Result<(), PlotError>
where
    X: Ranged<ValueType = f64>,
    Y: Ranged<ValueType = f64>,
{
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperRight)
        .background_style(WHITE.mix(0.85))
        .border_style(BLACK.mix(0.2))
        .label_font((FONT, 14))
        .draw()?;
    Ok(())
}
