//! Configurations from a file or standard input: JSON lines, or CSV.

use std::io::Read;
use std::path::Path;

use csv::StringRecord;
use serde_json::Value;

use super::output::{Failure, one_line, shown};
use urdd_directory::regular;
use urdd_format::escape;
use urdd_format::readable::counted;
use urdd_robot::Robot;

/// Maximum size of the input, in bytes.
const MAX_BYTES: u64 = 1 << 30;

/// Configurations, stored one after another.
#[derive(Debug, Default)]
pub struct Listed {
    pub values: Vec<f64>,
    /// Number of configurations: a robot may have no DOFs.
    pub count: u64,
}

/// Configurations, line by line: each line is a JSON list with a value for each DOF, a JSON object of DOF names and values
/// (other DOFs are 0, or the bound nearest to 0), or comma-separated values. In CSV, the first line may contain the names
/// of the DOFs, in any order.
pub struct Lines<'a> {
    robot: &'a Robot,
    dofs: &'a [String],
    begun: Option<Form>,
}

enum Form {
    Json,
    /// The DOF of each column.
    Csv(Option<Vec<usize>>),
}

impl<'a> Lines<'a> {
    pub fn new(robot: &'a Robot) -> Result<Self, Failure> {
        Ok(Lines { robot, dofs: robot.dof_names()?, begun: None })
    }

    /// The configuration of a line; `None` for a line without one.
    pub fn next(&mut self, line: &str) -> Result<Option<Vec<f64>>, Failure> {
        if line.trim().is_empty() {
            return Ok(None);
        }
        let is_json = line.trim_start().starts_with(['[', '{']);
        if is_json && self.begun.is_none() {
            self.begun = Some(Form::Json);
        }
        match &self.begun {
            Some(Form::Json) => of_json(self.robot, self.dofs, line).map(Some),
            _ if line.trim_start().starts_with('#') => Ok(None),
            Some(Form::Csv(columns)) => {
                let given = check(self.dofs, numbers(&fields(line)?)?)?;
                let mut values = given.clone();
                for (dof, value) in columns.iter().flatten().zip(given) {
                    values[*dof] = value;
                }
                Ok(Some(values))
            }
            None => {
                let fields = fields(line)?;
                if fields.iter().all(|field| field.parse::<f64>().is_err()) {
                    self.begun = Some(Form::Csv(Some(self.columns(&fields)?)));
                    return Ok(None);
                }
                self.begun = Some(Form::Csv(None));
                check(self.dofs, numbers(&fields)?).map(Some)
            }
        }
    }

    /// The DOFs that the first line of CSV names.
    fn columns(&self, names: &StringRecord) -> Result<Vec<usize>, Failure> {
        let found = names.iter().map(|name| self.robot.dof(name));
        let found: Vec<usize> = found.collect::<Result<_, _>>()?;
        if let Some(missing) = (0..self.dofs.len()).find(|dof| !found.contains(dof)) {
            let name = escape::line(&self.dofs[missing]);
            Err(format!("the column for the DOF `{name}` is missing"))?;
        }
        if found.len() != self.dofs.len() {
            Err("a DOF has two columns")?;
        }
        Ok(found)
    }
}

/// Reads configurations: [`Lines`].
///
/// # Errors
/// A message with the line number.
pub fn read(robot: &Robot, file: &Path) -> Result<Listed, Failure> {
    let name = match file.to_str() {
        Some("-") => "standard input".to_owned(),
        _ => shown(file),
    };
    let text = text(file).map_err(|error| format!("{name}: {error}"))?;
    let mut lines = Lines::new(robot)?;
    let mut found = Listed::default();
    for (number, line) in text.lines().enumerate() {
        let values = lines.next(line);
        let values = values.map_err(|why| format!("{name}:{}: {why}", number + 1))?;
        if let Some(values) = values {
            found.values.extend(values);
            found.count += 1;
        }
    }
    Ok(found)
}

fn text(file: &Path) -> Result<String, Failure> {
    let mut bytes = Vec::new();
    if file.as_os_str() == "-" {
        std::io::stdin().lock().take(MAX_BYTES).read_to_end(&mut bytes)?;
    } else {
        regular::open(file)?.take(MAX_BYTES).read_to_end(&mut bytes)?;
    }
    if bytes.len() as u64 == MAX_BYTES {
        Err(format!("it has more than {MAX_BYTES} bytes: split it into smaller files"))?;
    }
    Ok(String::from_utf8(bytes).map_err(|_| "it is not UTF-8")?)
}

fn of_json(robot: &Robot, dofs: &[String], line: &str) -> Result<Vec<f64>, Failure> {
    let value: Value = serde_json::from_str(line).map_err(|error| {
        format!("not JSON ({error}): give a list of {} values on each line", dofs.len())
    })?;
    let number = |value: &Value| {
        value.as_f64().ok_or_else(|| format!("{} is not a number", one_line(value)))
    };
    match &value {
        Value::Array(values) => {
            let values: Result<Vec<f64>, String> = values.iter().map(number).collect();
            check(dofs, values?)
        }
        Value::Object(values) => {
            let mut configuration = robot.configurations()?.zero();
            for (name, value) in values {
                configuration[robot.dof(name)?] = number(value)?;
            }
            check(dofs, configuration)
        }
        _ => Err("neither a list nor an object".into()),
    }
}

fn fields(line: &str) -> Result<StringRecord, csv::Error> {
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .trim(csv::Trim::All)
        .buffer_capacity(line.len().max(1))
        .from_reader(line.as_bytes());
    let mut record = StringRecord::new();
    reader.read_record(&mut record)?;
    Ok(record)
}

fn numbers(fields: &StringRecord) -> Result<Vec<f64>, String> {
    let parse = |field: &str| {
        let why = |_| format!("`{}` is not a number", escape::line(field));
        field.parse::<f64>().map_err(why)
    };
    fields.iter().map(parse).collect()
}

fn check(dofs: &[String], values: Vec<f64>) -> Result<Vec<f64>, Failure> {
    if values.len() != dofs.len() {
        let (found, expected) = (values.len(), dofs.len());
        let names: Vec<_> = dofs.iter().map(|name| escape::line(name)).collect();
        let names = names.join(", ");
        let (found, expected) = (counted(found, "value"), counted(expected, "DOF"));
        Err(format!("{found}, but the robot has {expected}: {names}"))?;
    }
    if let Some(dof) = values.iter().position(|value| !value.is_finite()) {
        let (name, value) = (escape::line(&dofs[dof]), values[dof]);
        Err(format!("the value of `{name}` is {value}, not a finite number"))?;
    }
    Ok(values)
}
