//! The header of a ply file.

use crate::error::Fault;
use crate::text::quoted;

/// How the values after the header are stored.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

/// The type of a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

/// The type of a property.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    Scalar(Scalar),
    List { count: Scalar, item: Scalar },
}

#[derive(Debug, PartialEq)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) kind: Kind,
}

#[derive(Debug, PartialEq)]
pub(super) struct Element {
    pub(super) name: String,
    /// As the header claims; nothing is allocated for it.
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
    /// The line of the header that declares it.
    pub(super) line: usize,
}

#[derive(Debug, PartialEq)]
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    /// Number of bytes, with the line break at the end.
    pub(super) length: usize,
    /// Number of lines.
    pub(super) lines: usize,
    /// Texture images that comments name, as MeshLab writes them.
    pub(super) textures: Vec<String>,
}

impl Header {
    pub(super) fn parse(bytes: &[u8]) -> Result<Self, Fault> {
        let mut encoding = None;
        let mut elements: Vec<Element> = Vec::new();
        let (mut length, mut textures) = (0, Vec::new());
        for (i, raw) in bytes.split_inclusive(|&b| b == b'\n').enumerate() {
            let line = i + 1;
            length += raw.len();
            let text = String::from_utf8_lossy(raw);
            let words: Vec<&str> = text.split_whitespace().collect();
            match words[..] {
                ["ply"] if i == 0 => {}
                _ if i == 0 => return Err(Fault::line(line, "a ply file begins with a line \"ply\"")),
                ["format", word, _version] => encoding = Some(parse_encoding(word, line)?),
                ["element", name, count] => elements.push(parse_element(name, count, line)?),
                ["property", ref rest @ ..] => match elements.last_mut() {
                    Some(element) => element.properties.push(parse_property(rest, line)?),
                    None => return Err(Fault::line(line, "a property before the first element")),
                },
                ["end_header"] => {
                    let encoding = encoding.ok_or_else(|| Fault::line(line, "the header has no line \"format\""))?;
                    return Ok(Self { encoding, elements, length, lines: line, textures });
                }
                ["comment", "TextureFile", ref name @ ..] => textures.push(name.join(" ")),
                [] | ["comment" | "obj_info", ..] => {}
                [word, ..] => return Err(Fault::line(line, format!("{} is no header line of ply", quoted(word)))),
            }
        }
        Err(Fault::data("the ply header does not end"))
    }
}

fn parse_encoding(word: &str, line: usize) -> Result<Encoding, Fault> {
    match word {
        "ascii" => Ok(Encoding::Text),
        "binary_little_endian" => Ok(Encoding::LittleEndian),
        "binary_big_endian" => Ok(Encoding::BigEndian),
        _ => Err(Fault::line(line, format!("{} is no ply format", quoted(word)))),
    }
}

fn parse_element(name: &str, count: &str, line: usize) -> Result<Element, Fault> {
    let count = count.parse().map_err(|_| Fault::line(line, format!("{} is not a count", quoted(count))))?;
    Ok(Element { name: name.to_owned(), count, properties: Vec::new(), line })
}

fn parse_property(words: &[&str], line: usize) -> Result<Property, Fault> {
    let (kind, name) = match *words {
        ["list", count, item, name] => (Kind::List { count: parse_scalar(count, line)?, item: parse_scalar(item, line)? }, name),
        [scalar, name] => (Kind::Scalar(parse_scalar(scalar, line)?), name),
        _ => return Err(Fault::line(line, "a property needs a type and a name")),
    };
    Ok(Property { name: name.to_owned(), kind })
}

fn parse_scalar(word: &str, line: usize) -> Result<Scalar, Fault> {
    Ok(match word {
        "char" | "int8" => Scalar::I8,
        "uchar" | "uint8" => Scalar::U8,
        "short" | "int16" => Scalar::I16,
        "ushort" | "uint16" => Scalar::U16,
        "int" | "int32" => Scalar::I32,
        "uint" | "uint32" => Scalar::U32,
        "float" | "float32" => Scalar::F32,
        "double" | "float64" => Scalar::F64,
        _ => return Err(Fault::line(line, format!("{} is no type of ply", quoted(word)))),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_header_with_windows_line_ends() {
        let bytes = b"ply\r\nformat ascii 1.0\r\ncomment x\r\nelement face 2\r\nproperty list uint8 int32 a\r\nend_header\r\n3";
        let header = Header::parse(bytes).unwrap();
        assert_eq!((header.encoding, header.length, header.lines), (Encoding::Text, bytes.len() - 1, 6));
        let list = Property { name: "a".to_owned(), kind: Kind::List { count: Scalar::U8, item: Scalar::I32 } };
        assert_eq!(header.elements, [Element { name: "face".to_owned(), count: 2, properties: vec![list], line: 4 }]);
    }
}
