//! Checks an OBJ file line by line on its way into `tobj`.
//!
//! `tobj` trusts what it reads: it overflows on some indices, reads polylines as faces, takes no continued lines, gives
//! a corner without a normal that of its neighbour, and names no line in its errors. So it gets the file in a plain
//! form of its own: only `v`, `vt`, `vn`, `f`, `mtllib` and `usemtl` lines, whose numbers are finite and whose faces
//! name all three indices, counted from the start. Index 1 of `vt` and of `vn` is a zero vector that stands for "none".

use crate::scene::error::nearest_name;
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::io::{BufRead, Read, Write};
use std::path::Path;

/// The longest line, in bytes; a face of a million corners fits.
const MAX_LINE_BYTES: u64 = 32 << 20;
/// The most triangles of one file: three corners of each fit into 32-bit indices.
const MAX_TRIANGLES: u64 = 1 << 30;

/// What a face may refer to as its material: the names that the libraries read so far define.
pub(super) type MaterialNames = RefCell<BTreeSet<String>>;

/// The plain form of an OBJ file, as a reader of lines.
pub(super) struct ObjLines<'a, R> {
    input: R,
    /// The folder of the file, for the names of material libraries.
    folder: &'a Path,
    /// Where the faces' materials come from the file: the names known so far.
    materials: Option<&'a MaterialNames>,
    /// Whether normals are kept.
    smooth: bool,
    /// The bytes on their way out, and how many of them are out.
    line: Vec<u8>,
    taken: usize,
    number: usize,
    has_material: bool,
    /// `v`, `vt` and `vn` lines so far.
    pub(super) counts: [u64; 3],
    triangles: u64,
    /// Statements that have no meaning here, with their count.
    pub(super) ignored: BTreeMap<String, usize>,
    /// Why reading stopped early: what is wrong, and what to do.
    pub(super) problem: Option<(String, String)>,
}

/// What is wrong with a line, and what to do.
type LineResult = Result<(), (String, String)>;

impl<'a, R: BufRead> ObjLines<'a, R> {
    pub(super) fn new(input: R, folder: &'a Path, materials: Option<&'a MaterialNames>, smooth: bool) -> Self {
        Self {
            input,
            folder,
            materials,
            smooth,
            // The vectors that stand for "none".
            line: b"vt 0 0\nvn 0 0 0\n".to_vec(),
            taken: 0,
            number: 0,
            has_material: false,
            counts: [0; 3],
            triangles: 0,
            ignored: BTreeMap::new(),
            problem: None,
        }
    }

    /// The next line of the file, with the lines that continue it; `None` at the end.
    fn read_line(&mut self) -> Result<Option<String>, (String, String)> {
        let mut bytes = Vec::new();
        loop {
            let room = MAX_LINE_BYTES - bytes.len() as u64;
            let read = self.input.by_ref().take(room).read_until(b'\n', &mut bytes);
            let read = read.map_err(|error| (format!("cannot read further: {error}"), String::new()))?;
            self.number += 1;
            if bytes.len() as u64 >= MAX_LINE_BYTES {
                return Err((
                    format!("a line longer than {} MiB", MAX_LINE_BYTES >> 20),
                    "is it an OBJ file?".into(),
                ));
            }
            if read == 0 {
                // Comments are often in other encodings than UTF-8; only names could matter.
                return Ok((!bytes.is_empty()).then(|| String::from_utf8_lossy(&bytes).into_owned()));
            }
            let content = bytes.trim_ascii_end().len();
            if bytes[..content].last() != Some(&b'\\') || bytes.last() != Some(&b'\n') {
                return Ok(Some(String::from_utf8_lossy(&bytes).into_owned()));
            }
            bytes.truncate(content - 1);
            bytes.push(b' ');
        }
    }

    /// Puts the plain form of `line` on its way out.
    fn check_line(&mut self, line: &str) -> LineResult {
        let line = line.trim();
        let (keyword, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        match keyword {
            "v" => self.numbers(rest, "v", 0, 3),
            "vt" => self.numbers(rest, "vt", 1, 2),
            "vn" => self.numbers(rest, "vn", 2, 3),
            "f" => self.face(rest),
            "mtllib" => {
                self.libraries(rest.trim());
                Ok(())
            }
            "usemtl" => self.use_material(rest.trim()),
            // Groups and names have no meaning here; smoothing is by normals.
            "" | "o" | "g" | "s" => Ok(()),
            _ if keyword.starts_with('#') => Ok(()),
            _ => {
                let keyword: String = keyword.chars().take(20).collect();
                // A file of another kind has many; a few will do to tell.
                if self.ignored.len() < 100 || self.ignored.contains_key(&keyword) {
                    *self.ignored.entry(keyword).or_default() += 1;
                }
                Ok(())
            }
        }
    }

    /// A `v`, `vt` or `vn` line: passes on its first `wanted` numbers.
    fn numbers(&mut self, rest: &str, keyword: &str, kind: usize, wanted: usize) -> LineResult {
        let mut found = 0;
        let mut weight = None;
        self.line.extend_from_slice(keyword.as_bytes());
        for word in rest.split_whitespace().take_while(|word| !word.starts_with('#')) {
            let number: f32 = word.parse().map_err(|_| {
                let word: String = word.chars().take(20).collect();
                (
                    format!("expected a number after `{keyword}`, found `{word}`"),
                    String::new(),
                )
            })?;
            if !number.is_finite() {
                return Err((
                    format!("expected a finite number after `{keyword}`, found `{number}`"),
                    String::new(),
                ));
            }
            if found < wanted {
                self.line.push(b' ');
                self.line.extend_from_slice(word.as_bytes());
            }
            weight = Some(number);
            found += 1;
        }
        if keyword == "vt" && found == 1 {
            // A coordinate of a one-dimensional texture.
            self.line.extend_from_slice(b" 0");
        } else if found < wanted {
            return Err((
                format!("expected {wanted} numbers after `{keyword}`, found {found}"),
                String::new(),
            ));
        }
        if keyword == "v" && found == 4 && weight != Some(1.0) {
            let help = "the fourth number is a weight, which polygons do not have: divide by it, or leave it out";
            return Err(("a vertex has a weight other than 1".to_owned(), help.to_owned()));
        }
        if keyword == "v" && found >= 6 {
            *self.ignored.entry("vertex colours".to_owned()).or_default() += 1;
        }
        self.line.push(b'\n');
        self.counts[kind] += 1;
        Ok(())
    }

    fn face(&mut self, rest: &str) -> LineResult {
        if self.materials.is_some() && !self.has_material {
            let message = "a face has no material: no `usemtl` stands above it";
            return Err((
                message.to_owned(),
                "give the shape a `material`, or complete the mesh file".to_owned(),
            ));
        }
        self.line.push(b'f');
        let mut corners = 0_u64;
        for word in rest.split_whitespace().take_while(|word| !word.starts_with('#')) {
            let [vertex, uv, normal] = self.corner(word)?;
            let normal = if self.smooth { normal } else { 0 };
            // One more for the vectors that stand for "none".
            // Writing to memory cannot fail.
            let _ = write!(self.line, " {vertex}/{}/{}", uv + 1, normal + 1);
            corners += 1;
        }
        self.line.push(b'\n');
        if corners < 3 {
            self.line.clear();
            *self
                .ignored
                .entry("faces of fewer than three corners".to_owned())
                .or_default() += 1;
            return Ok(());
        }
        self.triangles += corners - 2;
        if self.triangles > MAX_TRIANGLES {
            return Err((
                format!("more than {MAX_TRIANGLES} triangles"),
                "use a coarser mesh".to_owned(),
            ));
        }
        Ok(())
    }

    /// The indices of a corner `v`, `v/vt`, `v//vn` or `v/vt/vn`, from 1; 0 where there is none.
    fn corner(&self, word: &str) -> Result<[u64; 3], (String, String)> {
        const KINDS: [&str; 3] = ["v", "vt", "vn"];
        let shown = || word.chars().take(40).collect::<String>();
        let help = || "a corner is written `v`, `v/vt`, `v//vn` or `v/vt/vn`".to_owned();
        let mut indices = [0; 3];
        if word.split('/').count() > 3 {
            return Err((format!("a face's corner `{}` has too many indices", shown()), help()));
        }
        for (kind, part) in word.split('/').enumerate() {
            if part.is_empty() && kind > 0 {
                continue;
            }
            let count = self.counts[kind];
            let index: i64 = part
                .parse()
                .map_err(|_| (format!("expected a face's corner, found `{}`", shown()), help()))?;
            let resolved = match u64::try_from(index) {
                Ok(index) => Some(index),
                // Negative ones count back from the last.
                Err(_) => (count + 1).checked_sub(index.unsigned_abs()),
            };
            indices[kind] = resolved.filter(|index| (1..=count).contains(index)).ok_or_else(|| {
                let name = KINDS[kind];
                let message = format!("a face refers to `{name}` number {index}, but {count} of them stand above it");
                (
                    message,
                    "indices count from 1, and negative ones back from the last".to_owned(),
                )
            })?;
        }
        Ok(indices)
    }

    /// Names with blanks are told from several names by which file there is.
    fn libraries(&mut self, rest: &str) {
        if self.materials.is_none() || rest.is_empty() {
            return;
        }
        if self.folder.join(rest).is_file() {
            self.line.extend_from_slice(format!("mtllib {rest}\n").as_bytes());
        } else {
            for name in rest.split_whitespace() {
                self.line.extend_from_slice(format!("mtllib {name}\n").as_bytes());
            }
        }
    }

    fn use_material(&mut self, name: &str) -> LineResult {
        let Some(materials) = self.materials else { return Ok(()) };
        let names = materials.borrow();
        if !names.contains(name) {
            let help = match names.is_empty() {
                true => "no `mtllib` with materials stands above; or give the shape a `material`".to_owned(),
                false => nearest_name(name, names.iter().map(String::as_str)),
            };
            let name: String = name.chars().take(40).collect();
            return Err((format!("no material library has the material `{name}`"), help));
        }
        self.has_material = true;
        self.line.extend_from_slice(format!("usemtl {name}\n").as_bytes());
        Ok(())
    }

    /// Fills `line` with the next plain lines; leaves it empty at the end.
    fn advance(&mut self) -> LineResult {
        self.line.clear();
        self.taken = 0;
        while self.line.is_empty() {
            let Some(line) = self.read_line()? else { return Ok(()) };
            self.check_line(&line)?;
        }
        Ok(())
    }
}

impl<R: BufRead> BufRead for ObjLines<'_, R> {
    fn fill_buf(&mut self) -> std::io::Result<&[u8]> {
        if self.problem.is_some() {
            return Err(std::io::Error::other("stopped at a bad line"));
        }
        if self.taken == self.line.len()
            && let Err((message, help)) = self.advance()
        {
            self.problem = Some((format!("line {}: {message}", self.number), help));
            return Err(std::io::Error::other("stopped at a bad line"));
        }
        Ok(&self.line[self.taken..])
    }

    fn consume(&mut self, amount: usize) {
        self.taken = (self.taken + amount).min(self.line.len());
    }
}

impl<R: BufRead> Read for ObjLines<'_, R> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        let length = self.fill_buf()?.read(buffer)?;
        self.consume(length);
        Ok(length)
    }
}
