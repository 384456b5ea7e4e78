//! Frames with a meaning: sites at tools and inertial measurement units, and sensors at the latter.

use super::super::subject::Subject;
use urdd_xml::writer::Element;

/// The site of a link, if its frame is that of a tool, or of an IMU with sensors.
pub(super) fn site(subject: &Subject, sensors: bool, link: usize) -> Option<Element> {
    let setup = subject.given.as_ref()?;
    let is_imu = sensors && setup.imus.value.contains(&link);
    (is_imu || setup.tools.value.contains(&link)).then(|| named(&subject.links[link]))
}

/// The site of a frame of that name.
pub(super) fn named(frame: &str) -> Element {
    Element::new("site").with("name", frame).with("group", "4")
}

/// A gyroscope and an accelerometer at each IMU.
pub(super) fn sensors(subject: &Subject) -> Element {
    let mut sensors = Element::new("sensor");
    for &link in subject.given.iter().flat_map(|setup| &setup.imus.value) {
        let site = subject.links[link].as_str();
        for kind in ["gyro", "accelerometer"] {
            let sensor = Element::new(kind).with("name", format!("{site}/{kind}"));
            sensors.push(sensor.with("site", site));
        }
    }
    sensors
}
