//! What packages install, by their CMakeLists.txt and setup.py.

use std::path::Path;

use urdd_directory::account::{Account, AccountError};
use urdd_directory::limits::ALLOWANCE;

use super::packages::memory;
use crate::installed::Installed;

fn installed(name: &str, text: &str) -> Installed {
    crate::installed::installed(Path::new("/p"), &memory(&[(&format!("p/{name}"), text)]))
}

fn first(installed: &Installed, path: &str) -> Option<String> {
    installed.source(path, &Account::default(), |_| true).expect("an account")
}

#[test]
fn cmake_says_where_files_are_installed() {
    let text = r#"
        project(arm_demo)  # project(other)
        install(DIRECTORY description/ros2_control "description/urdf" DESTINATION share/${PROJECT_NAME})
        install(DIRECTORY description/config/ DESTINATION "share/arm_demo/config/" FILES_MATCHING PATTERN "*.yaml")
        install(FILES nested/a.yaml b.yaml DESTINATION ${CMAKE_INSTALL_DATADIR}/${PROJECT_NAME}/data)
        install(FILES odd.in DESTINATION share/${PROJECT_NAME} RENAME even.yaml)
        install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/launch DESTINATION share/${PROJECT_NAME})
        #[[ install(DIRECTORY commented DESTINATION share/arm_demo) ]]
        install(DIRECTORY include/ DESTINATION include/${PROJECT_NAME})
        install(DIRECTORY other DESTINATION share/other_package)
        install(DIRECTORY ../up DESTINATION share/${PROJECT_NAME})
        install(TARGETS arm LIBRARY DESTINATION lib)
        install(FILES ${HEADERS} DESTINATION include/${PROJECT_NAME})
        if(X)
        install(
          DIRECTORY $<TARGET_FILE_DIR:arm>/made
          DESTINATION share/${PROJECT_NAME})
        endif()
    "#;
    let installed = installed("CMakeLists.txt", text);
    // By the documentation of install(): a slash at the end leaves the last name out.
    let expected = [
        ("ros2_control/a.xacro", Some("description/ros2_control/a.xacro")),
        ("urdf/b/c.xacro", Some("description/urdf/b/c.xacro")),
        ("config/a.yaml", Some("description/config/a.yaml")),
        ("data/a.yaml", Some("nested/a.yaml")),
        ("data/b.yaml", Some("b.yaml")),
        ("even.yaml", Some("odd.in")),
        ("launch/a.py", Some("launch/a.py")),
        ("description/urdf/b.xacro", None),
        ("urdfs/b.xacro", None),
        ("up/a", None),
        ("commented/a", None),
        ("other/a", None),
        ("odd.in", None),
    ];
    for (path, source) in expected {
        assert_eq!(first(&installed, path).as_deref(), source, "{path}");
    }
    assert!(!installed.is_as_source());
    assert_eq!(installed.unknown, Some(("CMakeLists.txt", 15)));
    let plain = "project(a)\ninstall(DIRECTORY urdf meshes DESTINATION share/${PROJECT_NAME})";
    let plain = self::installed("CMakeLists.txt", plain);
    assert!(plain.is_as_source() && plain.unknown.is_none() && plain.rules.len() == 2);
}

#[test]
fn a_long_name_is_not_put_in_very_often() {
    let name = "n".repeat(300_000);
    let words = "${PROJECT_NAME} ".repeat(30_000);
    let text = format!("project({name})\ninstall(FILES {words} DESTINATION share/x)");
    assert_eq!(installed("CMakeLists.txt", &text), Installed::default());
    let parts = "package_name + ".repeat(100);
    let text = format!("package_name = '{name}'\nsetup(data_files=[({parts} 'x', ['y'])])");
    assert_eq!(installed("setup.py", &text).rules, []);
}

#[test]
fn each_of_very_many_names_has_no_long_destination() {
    // A name takes a byte or two of the text, and what is made of it may take none of the destination's bytes.
    let (names, folder) = ("a ".repeat(40_000), "x".repeat(100_000));
    let cmake = format!("project(p)\ninstall(FILES {names} DESTINATION share/p/{folder})");
    assert_eq!(installed("CMakeLists.txt", &cmake), Installed::default());
    let names = "'a',".repeat(900);
    let python = format!(
        "name='p'\nlong='{}'\nsetup(name='p',\ndata_files=[('share/p/' {}, [{names}])])",
        "x".repeat(255),
        "+ long".repeat(60)
    );
    assert_eq!(installed("setup.py", &python).rules, []);
    // The first thousand that are installed one by one are known, and where the others begin.
    let cmake = format!("project(p)\n{}", "install(FILES a DESTINATION share/p/b)\n".repeat(1001));
    let known = installed("CMakeLists.txt", &cmake);
    assert_eq!((known.rules.len(), known.unknown), (1000, Some(("CMakeLists.txt", 1002))));
    let why = known.is_not_known(Path::new("/p")).expect("words");
    assert!(why.starts_with("/p/CMakeLists.txt:1002 installs more files"), "{why}");
}

#[test]
fn what_may_be_a_file_is_charged_for_each_that_is_looked_for() {
    // Folders of which any may have the file.
    let rules = "install(DIRECTORY m/ DESTINATION share/p/meshes)\n".repeat(1000);
    let known = installed("CMakeLists.txt", &format!("project(p)\n{rules}"));
    let account = Account::default();
    let looked = std::cell::Cell::new(0);
    let missing = |_: &str| {
        looked.set(looked.get() + 1);
        false
    };
    let mut meshes = (0..5000).map(|mesh| format!("meshes/{mesh}.stl"));
    let refused = meshes.find_map(|mesh| known.source(&mesh, &account, missing).err());
    assert!(matches!(refused, Some(AccountError::Overdrawn(_))));
    // Each costs 1,024 steps.
    assert_eq!(looked.get() as u64, ALLOWANCE >> 10);
    // Rules for other folders cost nothing.
    let rules: String =
        (0..1000).map(|at| format!("install(FILES s{at} DESTINATION share/p/t)\n")).collect();
    let known = installed("CMakeLists.txt", &format!("project(p)\n{rules}"));
    let account = Account::default();
    looked.set(0);
    for mesh in (0..5000).map(|mesh| format!("t/s{mesh}")) {
        assert_eq!(known.source(&mesh, &account, missing).expect("an account"), None);
    }
    assert_eq!(looked.get(), 1000);
}

#[test]
fn setup_py_says_where_files_are_installed() {
    let text = "
from glob import glob
package_name = 'arm_demo'
setup(
    name=package_name,
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml', 'data/a.yaml']),
        (os.path.join('share', package_name, 'urdf'), glob(os.path.join('description', '*.xacro'))),
        ('share/' + package_name + '/launch', glob('launch/*.py')),
    ],
    zip_safe=True)";
    let known = installed("setup.py", text);
    assert_eq!(first(&known, "urdf/arm.xacro").as_deref(), Some("description/arm.xacro"));
    assert_eq!(first(&known, "a.yaml").as_deref(), Some("data/a.yaml"));
    assert_eq!(first(&known, "launch/a.py").as_deref(), Some("launch/a.py"));
    assert_eq!(known.unknown, None);
    let computed =
        text.replace("('share/' + package_name + '/launch', glob('launch/*.py'))", "*all()");
    assert_eq!(installed("setup.py", &computed).unknown, Some(("setup.py", 6)));
}
