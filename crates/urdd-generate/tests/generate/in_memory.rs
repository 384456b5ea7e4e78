//! A URDD that is made in memory, of files in memory, is the one that is made on a disk.

use std::collections::BTreeMap;
use std::path::Path;

use testkit::files::below;
use urdd_generate::{
    GenerateError, Settings, SourceError, SourceFiles, SourceSettings, generate, generate_in_memory,
};

fn of_memory(files: BTreeMap<String, Vec<u8>>) -> Settings {
    let files = files.into_iter().map(|(path, bytes)| (path, bytes.into()));
    let files = SourceFiles::in_memory(files).expect("files");
    Settings { source: SourceSettings { files, ..Default::default() }, ..Default::default() }
}

#[test]
fn it_has_the_bytes_of_the_one_on_a_disk() {
    let robots = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../conformance/robots");
    for name in ["scaled_parts", "six_axis_arm"] {
        let folder = tempfile::tempdir().unwrap();
        let target = folder.path().join(name);
        let urdf = format!("{name}.urdf");
        let written = generate(&robots.join(&urdf), &target, &Settings::default(), &()).unwrap();
        let settings = of_memory(below(&robots));
        let (made, files) = generate_in_memory(Path::new(&urdf), &settings, &()).unwrap();
        let files: BTreeMap<_, _> =
            files.into_iter().map(|(path, bytes)| (path, bytes.to_vec())).collect();
        assert!(files.len() > 30, "{name}: {} files", files.len());
        assert_eq!(files, below(&target), "{name}");
        assert_eq!(made.meshes, written.meshes, "{name}");
        assert_eq!(made.class, written.class, "{name}");
    }
}

#[test]
fn settings_out_of_their_ranges_are_refused() {
    let urdf = b"<robot name=\"r\"><link name=\"a\"/></robot>".to_vec();
    let settings = of_memory(BTreeMap::from([("r.urdf".to_owned(), urdf)]));
    let said = |settings: &Settings| {
        let made = generate_in_memory(Path::new("r.urdf"), settings, &());
        made.err().map(|error| (error.code(), error.to_string()))
    };
    assert_eq!(said(&settings), None);
    let wrong = |change: &dyn Fn(&mut Settings), expected: &str| {
        let mut settings = settings.clone();
        change(&mut settings);
        assert_eq!(said(&settings), Some(("range", expected.to_owned())));
    };
    let pieces = "`pieces` must be a whole number from 1 to 64, not";
    wrong(&|of| of.pieces.most = 0, &format!("{pieces} 0"));
    wrong(&|of| of.pieces.most = 65, &format!("{pieces} 65"));
    let samples = "`samples` must be a whole number from 1 to 100,000, not";
    wrong(&|of| of.num_samples = 0, &format!("{samples} 0"));
    wrong(&|of| of.num_samples = 100_001, &format!("{samples} 100001"));
    for length in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let expected = format!("`piece_tolerance` must be above 0 metres, not {length}");
        wrong(&|of| of.pieces.tolerance = Some(length), &expected);
    }
}

#[test]
fn what_is_not_in_memory_is_not_there() {
    let error = generate_in_memory(Path::new("/etc/hostname"), &of_memory(BTreeMap::new()), &());
    let error = error.unwrap_err();
    assert!(matches!(error, GenerateError::Source(SourceError::Read { .. })), "{error}");
}
