//! Prints what a file composes, as JSON, for `tests/figures/imports/usd.py`: prims with their properties.

use std::io::Write;
use std::path::PathBuf;
use std::sync::Arc;

use serde_json::{Map, Value as Json, json};
use urdd_directory::account::{Account, AccountError};
use urdd_usd::{Door, Property, Value, open};

/// The folder of the root layer.
struct Folder(PathBuf);

impl Door for Folder {
    fn read(&mut self, path: &str) -> Result<Arc<[u8]>, String> {
        std::fs::read(self.0.join(path)).map(Arc::from).map_err(|why| why.to_string())
    }

    fn charge(&self, _: usize) -> Result<(), AccountError> {
        Ok(())
    }
}

fn main() -> std::io::Result<()> {
    let mut out = std::io::stdout().lock();
    for file in std::env::args().skip(1) {
        let path = PathBuf::from(&file);
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let folder = path.parent().map(PathBuf::from).unwrap_or_default();
        writeln!(out, "{}", dump(&file, &name, folder))?;
    }
    Ok(())
}

fn dump(file: &str, name: &str, folder: PathBuf) -> Json {
    let start = std::time::Instant::now();
    let stage = match open(name, &mut Folder(folder)) {
        Ok(stage) => stage,
        Err(error) => return json!({ "file": file, "error": error.to_string() }),
    };
    let seconds = start.elapsed().as_secs_f64();
    let mut prims = Map::new();
    for (at, prim) in stage.prims.iter().enumerate() {
        let properties: Map<String, Json> =
            prim.properties.iter().map(|of| (of.name.to_string(), property(of))).collect();
        let schemas: Vec<&str> = prim.schemas.iter().map(|name| &**name).collect();
        let of = json!({ "type": &*prim.type_name, "schemas": schemas, "properties": properties });
        prims.insert(stage.path(at, &unlimited()).unwrap_or_default(), of);
    }
    json!({ "file": file, "prims": prims, "seconds": seconds })
}

/// An account that has all.
fn unlimited() -> Account {
    let account = Account::default();
    account.deposit(usize::MAX);
    account
}

fn property(of: &Property) -> Json {
    let targets = of.targets().walk(&unlimited()).into_iter().flatten();
    let targets: Vec<&str> = targets.map(|path| &**path).collect();
    let own = of.value().and_then(|of| of.take(&unlimited()).ok());
    json!({ "type": &*of.type_name, "value": own.map(value), "targets": targets })
}

fn value(of: &Value) -> Json {
    let number = |number: &f64| match number.is_finite() {
        true => json!(number),
        false => json!(number.to_string()),
    };
    match of {
        Value::Bool(value) => json!(value),
        Value::Number(of) => number(of),
        Value::Text(text) | Value::Path(text) => json!(&**text),
        Value::Asset(path) => json!({ "asset": &**path }),
        Value::Tuple(values) => values.iter().map(number).collect(),
        Value::Numbers { width: 1, values } => values.iter().map(number).collect(),
        Value::Numbers { width, values } => {
            values.chunks(*width).map(|entry| entry.iter().map(number).collect::<Json>()).collect()
        }
        Value::Texts(texts) => texts.iter().map(|text| json!(&**text)).collect(),
        Value::Dictionary(entries) => {
            entries.iter().map(|(name, of)| (name.to_string(), value(of))).collect()
        }
        Value::Blocked | Value::List(_) | Value::Samples(_) | Value::Unread(_) => Json::Null,
    }
}
