//! Numbers as the functions of C and C++ read them, in the C locale; each gives the number and the text behind it. Vectors, matrices
//! and poses, for readers that compute inertias as their programs do.

/// A number, and what follows it.
pub type Read<'a> = Option<(f64, &'a str)>;

/// As `isspace` of C has it.
pub fn is_space(character: char) -> bool {
    matches!(character, ' ' | '\t'..='\r')
}

/// `strtod`: white space, a sign, then a decimal or hexadecimal number, `inf` or `nan`. None if nothing is read.
pub fn strtod(text: &str) -> Read<'_> {
    let (sign, unsigned) = signed(text.trim_start_matches(is_space));
    let (number, rest) =
        hexadecimal(unsigned).or_else(|| word(unsigned)).or_else(|| decimal(unsigned))?;
    Some((sign * number, rest))
}

/// `istream >> double` of libstdc++: white space, a sign and a decimal number. None also if the number is too large, or
/// ends with `e`.
pub fn istream(text: &str) -> Read<'_> {
    let (sign, unsigned) = signed(text.trim_start_matches(is_space));
    let (number, rest) = decimal(unsigned).filter(|(number, _)| number.is_finite())?;
    let read = &unsigned[..unsigned.len() - rest.len()];
    let is_cut = rest.starts_with(['e', 'E']) && !read.contains(['e', 'E']);
    (!is_cut).then_some((sign * number, rest))
}

/// Whether a text is a number and nothing else, by one of the functions above.
pub fn whole(read: Read<'_>) -> Option<f64> {
    read.filter(|(_, rest)| rest.is_empty()).map(|(number, _)| number)
}

/// What is between spaces, and no other white space.
pub fn pieces(text: &str) -> impl Iterator<Item = &str> {
    text.split(' ').filter(|piece| !piece.is_empty())
}

/// The sign of a number, and what follows it.
fn signed(text: &str) -> (f64, &str) {
    let sign = if text.starts_with('-') { -1.0 } else { 1.0 };
    (sign, text.strip_prefix(['+', '-']).unwrap_or(text))
}

/// Digits with an optional point and exponent.
fn decimal(text: &str) -> Read<'_> {
    let digits = |text: &str| text.bytes().take_while(u8::is_ascii_digit).count();
    let whole = digits(text);
    let mut end = whole;
    let mut has_digits = whole > 0;
    if text[end..].starts_with('.') {
        let fraction = digits(&text[end + 1..]);
        has_digits |= fraction > 0;
        end += 1 + fraction;
    }
    if !has_digits {
        return None;
    }
    end += exponent(&text[end..], ['e', 'E']).len();
    Some((text[..end].parse().ok()?, &text[end..]))
}

/// The exponent that a text begins with: a mark, perhaps a sign, and digits; empty if it has none.
fn exponent(text: &str, mark: [char; 2]) -> &str {
    let Some(behind) = text.strip_prefix(mark) else { return "" };
    let (_, unsigned) = signed(behind);
    match unsigned.bytes().take_while(u8::is_ascii_digit).count() {
        0 => "",
        digits => &text[..text.len() - unsigned.len() + digits],
    }
}

/// `inf`, `infinity`, `nan` and `nan(...)`, in any case.
fn word(text: &str) -> Read<'_> {
    let starts =
        |word: &str| text.get(..word.len()).is_some_and(|one| one.eq_ignore_ascii_case(word));
    let words = [("infinity", f64::INFINITY), ("inf", f64::INFINITY), ("nan", f64::NAN)];
    let (word, number) = words.into_iter().find(|(word, _)| starts(word))?;
    let rest = &text[word.len()..];
    let inside = rest.strip_prefix('(').filter(|_| number.is_nan());
    let behind = inside.and_then(|inside| inside.split_once(')'));
    let is_word = |tag: &str| tag.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_');
    Some((number, behind.filter(|(tag, _)| is_word(tag)).map_or(rest, |(_, behind)| behind)))
}

/// `0x`, hexadecimal digits with an optional point, and an optional binary exponent.
fn hexadecimal(text: &str) -> Read<'_> {
    let body = text.strip_prefix("0x").or_else(|| text.strip_prefix("0X"))?;
    let (mut number, mut scale, mut digits, mut end) = (0.0, 1.0, 0, 0);
    let mut has_point = false;
    for (at, character) in body.char_indices() {
        match character.to_digit(16) {
            Some(digit) => {
                number = number * 16.0 + f64::from(digit);
                scale *= if has_point { 16.0 } else { 1.0 };
                digits += 1;
            }
            None if character == '.' && !has_point => has_point = true,
            None => break,
        }
        end = at + 1;
    }
    if digits == 0 {
        return None;
    }
    let exponent = exponent(&body[end..], ['p', 'P']);
    let (sign, digits) = signed(exponent.get(1..).unwrap_or_default());
    let power: i32 = if digits.is_empty() { 0 } else { digits.parse().unwrap_or(i32::MAX) };
    let power = sign * f64::from(power);
    Some((number / scale * power.exp2(), &body[end + exponent.len()..]))
}

/// `float()` of Python: any white space around, `_` between digits, digits of any script.
pub fn python(text: &str) -> Option<f64> {
    let text = text.trim();
    let mut plain = String::with_capacity(text.len());
    let mut rest = text.chars().map(digit).peekable();
    while let Some(character) = rest.next() {
        let is_between = plain.ends_with(|last: char| last.is_ascii_digit())
            && rest.peek().is_some_and(char::is_ascii_digit);
        if character != '_' || !is_between {
            plain.push(character);
        }
    }
    plain.parse().ok()
}

/// A digit of another script as that of ASCII.
fn digit(character: char) -> char {
    const ZEROS: [u32; 16] = [
        0x660, 0x6f0, 0x7c0, 0x966, 0x9e6, 0xa66, 0xae6, 0xb66, 0xbe6, 0xc66, 0xce6, 0xd66, 0xe50,
        0xed0, 0xf20, 0xff10,
    ];
    let code = u32::from(character);
    let value = ZEROS.iter().filter_map(|zero| code.checked_sub(*zero)).find(|value| *value < 10);
    value.and_then(|value| char::from_digit(value, 10)).unwrap_or(character)
}

/// `parseFloat()` of `JavaScript`: the longest beginning that is a number, behind any white space; NaN if there is none.
pub fn parse_float(text: &str) -> f64 {
    let is_space = |character: char| {
        character == '\u{feff}' || (character.is_whitespace() && character != '\u{85}')
    };
    let (sign, unsigned) = signed(text.trim_start_matches(is_space));
    match decimal(unsigned) {
        Some((number, _)) => sign * number,
        None if unsigned.starts_with("Infinity") => sign * f64::INFINITY,
        None => f64::NAN,
    }
}

pub type Vector = [f64; 3];
pub type Matrix = [[f64; 3]; 3];

/// A place and a turn.
#[derive(Clone, Copy)]
pub struct Pose {
    pub xyz: Vector,
    pub turn: Matrix,
}

impl Default for Pose {
    fn default() -> Pose {
        Pose { xyz: [0.0; 3], turn: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] }
    }
}

impl Pose {
    /// Of an `<origin>`. Angles that are not finite are 0.
    pub fn new(xyz: Vector, rpy: Vector) -> Pose {
        let [(sr, cr), (sp, cp), (sy, cy)] =
            rpy.map(|angle| if angle.is_finite() { angle.sin_cos() } else { (0.0, 1.0) });
        let turn = [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ];
        Pose { xyz, turn }
    }

    /// The pose of something that has a pose in this one.
    pub fn then(&self, inner: &Pose) -> Pose {
        Pose { xyz: self.place(inner.xyz), turn: product(&self.turn, &inner.turn) }
    }

    pub fn place(&self, point: Vector) -> Vector {
        [0, 1, 2].map(|row| self.xyz[row] + dot(self.turn[row], point))
    }
}

/// A tensor about other axes.
pub fn turned(tensor: &Matrix, turn: &Matrix) -> Matrix {
    product(&product(turn, tensor), &transposed(turn))
}

/// The tensor of a mass about its centre, about another point.
pub fn moved(tensor: &Matrix, mass: f64, centre: Vector, point: Vector) -> Matrix {
    let arm = less(centre, point);
    let mut moved = *tensor;
    for row in 0..3 {
        for column in 0..3 {
            let square = if row == column { dot(arm, arm) } else { 0.0 };
            moved[row][column] += mass * (square - arm[row] * arm[column]);
        }
    }
    moved
}

/// The centre of two masses together.
pub fn centre(masses: [f64; 2], centres: [Vector; 2]) -> Vector {
    let sum = masses[0] + masses[1];
    [0, 1, 2].map(|axis| (masses[0] * centres[0][axis] + masses[1] * centres[1][axis]) / sum)
}

pub fn sum(a: &Matrix, b: &Matrix) -> Matrix {
    [0, 1, 2].map(|row| [0, 1, 2].map(|column| a[row][column] + b[row][column]))
}

pub fn product(a: &Matrix, b: &Matrix) -> Matrix {
    let b = transposed(b);
    a.map(|row| b.map(|column| dot(row, column)))
}

pub fn transposed(a: &Matrix) -> Matrix {
    [0, 1, 2].map(|column| a.map(|row| row[column]))
}

pub fn less(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
