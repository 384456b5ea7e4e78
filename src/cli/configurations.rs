//! Configurations from a file or standard input: JSON lines, or CSV.

use std::io::Read;
use std::path::Path;

use serde_json::Value;

use urdd_directory::regular;
use urdd_format::escape;
use urdd_robot::Robot;

/// Maximum size of the input, in bytes.
const MAX_BYTES: u64 = 1 << 30;

/// Configurations, stored one after another.
#[derive(Debug, Default)]
pub struct Listed {
    /// The values of all of them.
    pub values: Vec<f64>,
    /// Number of configurations: a robot may have no DOFs.
    pub count: u64,
}

impl Listed {
    fn push(&mut self, values: &[f64]) {
        self.values.extend(values);
        self.count += 1;
    }
}

/// Reads configurations. Each line is a JSON list with a value for each DOF, a JSON object of DOF names and values
/// (other DOFs are 0, or the bound nearest to 0), or comma-separated values. In CSV, the first line may contain the
/// names of the DOFs, in any order.
///
/// # Errors
/// A message with the line number.
pub fn read(robot: &Robot, file: &Path) -> Result<Listed, String> {
    let name = match file.to_str() {
        Some("-") => "standard input".to_owned(),
        _ => escape::line(&file.display().to_string()).into_owned(),
    };
    let text = text(file).map_err(|error| format!("{name}: {error}"))?;
    let dofs = robot.dof_names().map_err(|error| error.to_string())?;
    let is_json = text.trim_start().starts_with(['[', '{']);
    if is_json {
        let mut found = Listed::default();
        for (number, line) in text.lines().enumerate() {
            if !line.trim().is_empty() {
                let values = of_json(robot, dofs, line);
                found.push(&values.map_err(|why| format!("{name}:{}: {why}", number + 1))?);
            }
        }
        Ok(found)
    } else {
        of_csv(robot, dofs, &text).map_err(|(line, why)| format!("{name}:{line}: {why}"))
    }
}

fn text(file: &Path) -> Result<String, String> {
    let mut bytes = Vec::new();
    let read = if file.as_os_str() == "-" {
        std::io::stdin()
            .lock()
            .take(MAX_BYTES)
            .read_to_end(&mut bytes)
    } else {
        let file = regular::open(file).map_err(|error| error.to_string())?;
        file.take(MAX_BYTES).read_to_end(&mut bytes)
    };
    read.map_err(|error| error.to_string())?;
    if bytes.len() as u64 == MAX_BYTES {
        return Err(format!(
            "it has more than {MAX_BYTES} bytes: split it into smaller files"
        ));
    }
    String::from_utf8(bytes).map_err(|_| "it is not UTF-8".to_owned())
}

fn of_json(robot: &Robot, dofs: &[String], line: &str) -> Result<Vec<f64>, String> {
    let value: Value = serde_json::from_str(line).map_err(|error| {
        format!(
            "not JSON ({error}): give a list of {} values on each line",
            dofs.len()
        )
    })?;
    let number = |value: &Value| {
        value
            .as_f64()
            .ok_or_else(|| format!("{} is not a number", escape::line(&value.to_string())))
    };
    match &value {
        Value::Array(values) => {
            let values: Result<Vec<f64>, String> = values.iter().map(number).collect();
            check(dofs, values?)
        }
        Value::Object(values) => {
            let configurations = robot.configurations().map_err(|error| error.to_string())?;
            let mut configuration = configurations.zero();
            for (name, value) in values {
                let dof = robot.dof(name).map_err(|error| error.to_string())?;
                configuration[dof] = number(value)?;
            }
            check(dofs, configuration)
        }
        _ => Err("neither a list nor an object".to_owned()),
    }
}

fn of_csv(robot: &Robot, dofs: &[String], text: &str) -> Result<Listed, (u64, String)> {
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .trim(csv::Trim::All)
        .comment(Some(b'#'))
        .from_reader(text.as_bytes());
    let mut columns: Option<Vec<usize>> = None;
    let mut configurations = Listed::default();
    for (number, record) in reader.records().enumerate() {
        let record = record.map_err(|error| {
            let line = error.position().map_or(0, csv::Position::line);
            (line, error.to_string())
        })?;
        let line = record.position().map_or(0, csv::Position::line);
        let fail = |why: String| (line, why);
        if number == 0 && record.iter().all(|field| field.parse::<f64>().is_err()) {
            let index = |name: &str| robot.dof(name).map_err(|error| fail(error.to_string()));
            let found: Vec<usize> = record.iter().map(index).collect::<Result<_, _>>()?;
            if let Some(missing) = (0..dofs.len()).find(|dof| !found.contains(dof)) {
                let name = escape::line(&dofs[missing]);
                return Err(fail(format!("the column for the DOF `{name}` is missing")));
            }
            if found.len() != dofs.len() {
                return Err(fail("a DOF has two columns".to_owned()));
            }
            columns = Some(found);
            continue;
        }
        let parse = |field: &str| {
            let why = || fail(format!("`{}` is not a number", escape::line(field)));
            field.parse::<f64>().map_err(|_| why())
        };
        let values: Vec<f64> = record.iter().map(parse).collect::<Result<_, _>>()?;
        let mut values = check(dofs, values).map_err(fail)?;
        if let Some(columns) = &columns {
            let given = values.clone();
            columns
                .iter()
                .zip(given)
                .for_each(|(dof, value)| values[*dof] = value);
        }
        configurations.push(&values);
    }
    Ok(configurations)
}

fn check(dofs: &[String], values: Vec<f64>) -> Result<Vec<f64>, String> {
    if values.len() != dofs.len() {
        let (found, expected) = (values.len(), dofs.len());
        let names: Vec<_> = dofs.iter().map(|name| escape::line(name)).collect();
        return Err(format!(
            "{found} values, but the robot has {expected} DOFs: {}",
            names.join(", ")
        ));
    }
    match values.iter().position(|value| !value.is_finite()) {
        Some(dof) => Err(format!(
            "the value of `{}` is {}, not a finite number",
            escape::line(&dofs[dof]),
            values[dof]
        )),
        None => Ok(values),
    }
}
