//! The reader of `urdd.toml`.

use urdd_validate::settings::Settings;

/// Accepted settings can be applied; rejected ones have a message.
pub fn settings(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else {
        return;
    };
    let settings = match Settings::from_toml(text) {
        Ok(settings) => settings,
        Err(error) => {
            assert!(!error.to_string().is_empty());
            return;
        }
    };
    for ignore in &settings.ignores {
        assert!(!ignore.reason.trim().is_empty());
        ignore.path.is_match("arms/z1/mesh_modules/plain_meshes_module/meshes/0_base.stl");
        ignore.path.is_match("");
    }
    // No URDD was examined, so no ignore matched.
    let stale = settings.apply(&mut []);
    assert_eq!(stale.len(), settings.ignores.len());
}
