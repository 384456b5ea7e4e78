use super::prelude::*;
use urdd_format::report::Fix;

declare_lint! {
    /// A number of a colour is below 0 or above 1.
    ///
    /// urdfdom 6 drops the material, yourdfpy stops, other programs show white. Mostly these are 0 to 255.
    ///
    /// Divide by 255.
    LNT048 "color-out-of-range", Warning, Appearance, since "1.1.0"
}

/// A rounded 1.
const MOST: f64 = 1.001;
const BYTE: f64 = 255.0;

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let colors = urdf.root.descendants().filter(|node| node.tag_name().name() == "color");
    for color in colors {
        let Some(rgba) = numbers::<4>(color, "rgba") else {
            continue;
        };
        if rgba.iter().all(|value| (0.0..=MOST).contains(value)) {
            continue;
        }
        let message = "a colour is red, green, blue and opacity from 0 to 1; divide by 255";
        let is_bytes = rgba.iter().all(|value| (0.0..=BYTE).contains(value));
        let fix = urdf.value(color, "rgba").filter(|_| is_bytes).map(|range| {
            // An opacity of 1 beside bytes may be either.
            let [r, g, b, a] = rgba;
            let a = if a <= MOST { a } else { a / BYTE };
            let mended = [r / BYTE, g / BYTE, b / BYTE, a].map(|value| format!("{value}"));
            let fix = urdf.fix("divide the colour by 255", range, mended.join(" "));
            Fix { is_safe: false, ..fix }
        });
        urdf.at_attribute(color, "rgba", message).fix(fix).report(findings);
    }
    Some(())
}
