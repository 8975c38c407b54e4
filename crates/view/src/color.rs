//! Colours and colour maps.

/// Red, green and blue, 0 to 255.
pub type Rgb = [u8; 3];

/// Colour of a triangle quality (AR): red at 0.3 and below, yellow at 0.65, green at 1.
pub fn quality_color(ar: f64) -> Rgb {
    const RED_TO_GREEN: [Rgb; 5] = [[165, 0, 38], [244, 109, 67], [255, 255, 191], [102, 189, 99], [0, 104, 55]];
    ramp(&RED_TO_GREEN, (ar - 0.3) / 0.7)
}

/// Colour of a distance given as a share of the box diagonal: blue at 1e-6 and below, green at 3e-5, red at 1e-3 and above.
pub fn distance_color(d: f64) -> Rgb {
    const BLUE_TO_RED: [Rgb; 5] = [[40, 60, 180], [50, 180, 220], [110, 210, 90], [245, 190, 50], [190, 20, 20]];
    ramp(&BLUE_TO_RED, (d.max(1e-9).log10() + 6.0) / 3.0)
}

/// Colour of a vertex valence: 6 light grey, 5 blue, 7 red, less than 5 violet, more than 7 orange.
pub fn valence_color(valence: usize) -> Rgb {
    match valence {
        0..=4 => [130, 20, 170],
        5 => [40, 90, 220],
        6 => [215, 215, 215],
        7 => [220, 40, 40],
        _ => [255, 150, 0],
    }
}

/// The `i`-th of endlessly many colours: neighbours in the order differ strongly.
pub fn palette(i: usize) -> Rgb {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let hue = (0.07 + i as f64 * GOLDEN).fract();
    let saturation = [0.50, 0.72, 0.38][i % 3];
    let value = [0.92, 0.78][i / 3 % 2];
    hsv(hue, saturation, value)
}

/// Hue, saturation and value, each in 0..1, as red, green and blue.
fn hsv(hue: f64, saturation: f64, value: f64) -> Rgb {
    [5.0, 3.0, 1.0].map(|shift| {
        let k = (shift + 6.0 * hue) % 6.0;
        let dip = saturation * k.min(4.0 - k).clamp(0.0, 1.0);
        (255.0 * value * (1.0 - dip)).round() as u8
    })
}

/// The colour at `t` in 0..1 (clamped, 0 for a `t` that is not a number) along evenly spaced stops.
fn ramp(stops: &[Rgb; 5], t: f64) -> Rgb {
    let x = if t.is_nan() { 0.0 } else { t.clamp(0.0, 1.0) * 4.0 };
    let i = (x as usize).min(3);
    mix(stops[i], stops[i + 1], x - i as f64)
}

/// `a` at `t = 0`, `b` at `t = 1`.
pub(crate) fn mix(a: Rgb, b: Rgb, t: f64) -> Rgb {
    [0, 1, 2].map(|c| (f64::from(a[c]) * (1.0 - t) + f64::from(b[c]) * t).round() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_of_the_maps() {
        assert_eq!(quality_color(0.1), [165, 0, 38]);
        assert_eq!(quality_color(1.0), [0, 104, 55]);
        assert_eq!(distance_color(0.0), [40, 60, 180]);
        assert_eq!(distance_color(1.0), [190, 20, 20]);
        assert_eq!(quality_color(f64::NAN), [165, 0, 38]);
    }

    #[test]
    fn pure_hues() {
        assert_eq!(hsv(0.0, 1.0, 1.0), [255, 0, 0]);
        assert_eq!(hsv(1.0 / 3.0, 1.0, 1.0), [0, 255, 0]);
        assert_eq!(hsv(2.0 / 3.0, 1.0, 1.0), [0, 0, 255]);
    }

    #[test]
    fn the_first_palette_colours_are_distinct() {
        let colors: std::collections::BTreeSet<_> = (0..200).map(palette).collect();
        assert_eq!(colors.len(), 200);
    }
}
