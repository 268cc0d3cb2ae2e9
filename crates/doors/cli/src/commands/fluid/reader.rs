//! Tables of a scene, read key by key; what is left over is an error with its line and the nearest name.

use anyhow::{anyhow, bail};
use std::path::Path;
use toml_edit::{Document, Item, TableLike, Value};

/// A scene file.
pub(crate) struct SceneFile {
    document: Document<String>,
    place: String,
}

/// A table of it. Every key must be asked for before the end.
pub(crate) struct Reader<'t> {
    file: &'t SceneFile,
    table: &'t dyn TableLike,
    known: Vec<&'static str>,
}

/// Names that are at least this similar are suggested.
const SIMILAR: f64 = 0.6;

impl SceneFile {
    pub(crate) fn parse(path: &Path, text: String) -> anyhow::Result<Self> {
        let place = path.display().to_string();
        let lines = text.clone();
        let document = Document::parse(text).map_err(|error| {
            let line = error.span().map_or(1, |span| line(&lines, span.start));
            // Messages of the parser may go over several lines.
            let message = error.message().replace('\n', ", ");
            anyhow!("{place}: line {line}: {message}")
        })?;
        Ok(Self { document, place })
    }

    pub(crate) fn top(&self) -> Reader<'_> {
        Reader { file: self, table: self.document.as_table(), known: Vec::new() }
    }
}

impl<'t> Reader<'t> {
    fn item(&mut self, key: &'static str) -> Option<&'t Item> {
        self.known.push(key);
        self.table.get(key).filter(|item| !item.is_none())
    }

    /// An error about an item: the file, the line, the key, and what was expected.
    fn error(&self, key: &str, item: &Item, expected: &str) -> anyhow::Error {
        let line = item.span().map_or(1, |span| line(self.file.document.raw(), span.start));
        let place = &self.file.place;
        anyhow!("{place}: line {line}: `{key}` is {}, expected {expected}", described(item))
    }

    pub(crate) fn number(&mut self, key: &'static str) -> anyhow::Result<Option<f64>> {
        let Some(item) = self.item(key) else { return Ok(None) };
        let number = item.as_value().and_then(number);
        number.map(Some).ok_or_else(|| self.error(key, item, "a number"))
    }

    pub(crate) fn count(&mut self, key: &'static str) -> anyhow::Result<Option<usize>> {
        let Some(item) = self.item(key) else { return Ok(None) };
        let count = item.as_integer().and_then(|n| usize::try_from(n).ok());
        count.map(Some).ok_or_else(|| self.error(key, item, "a whole number that is not negative"))
    }

    pub(crate) fn text(&mut self, key: &'static str) -> anyhow::Result<Option<String>> {
        let Some(item) = self.item(key) else { return Ok(None) };
        item.as_str()
            .map(|text| Some(text.to_owned()))
            .ok_or_else(|| self.error(key, item, "a text in quotes"))
    }

    /// One of some names.
    pub(crate) fn name<T>(
        &mut self,
        key: &'static str,
        names: &[&str],
        parse: impl Fn(&str) -> Option<T>,
    ) -> anyhow::Result<Option<T>> {
        let Some(item) = self.item(key) else { return Ok(None) };
        let found = item.as_str().and_then(parse);
        found.map(Some).ok_or_else(|| self.error(key, item, &format!("one of {}", names.join(", "))))
    }

    pub(crate) fn numbers(&mut self, key: &'static str) -> anyhow::Result<Option<Vec<f64>>> {
        let Some(item) = self.item(key) else { return Ok(None) };
        let numbers = item.as_array().and_then(|array| array.iter().map(number).collect());
        numbers.map(Some).ok_or_else(|| self.error(key, item, "a list of numbers"))
    }

    pub(crate) fn vector(&mut self, key: &'static str) -> anyhow::Result<Option<[f64; 3]>> {
        let Some(numbers) = self.numbers(key)? else { return Ok(None) };
        let Some(item) = self.item(key) else { return Ok(None) };
        <[f64; 3]>::try_from(numbers)
            .map(Some)
            .map_err(|_| self.error(key, item, "three numbers, such as [0, 0, 1]"))
    }

    /// Tables of one name: `[[name]]`, `[name]`, or lists of inline tables.
    pub(crate) fn tables(&mut self, key: &'static str) -> anyhow::Result<Vec<Reader<'t>>> {
        let Some(item) = self.item(key) else { return Ok(Vec::new()) };
        let file = self.file;
        let reader = |table: &'t dyn TableLike| Reader { file, table, known: Vec::new() };
        if let Some(table) = item.as_table_like() {
            return Ok(vec![reader(table)]);
        }
        if let Some(tables) = item.as_array_of_tables() {
            return Ok(tables.iter().map(|table| reader(table)).collect());
        }
        let inline = item.as_array().map(|array| {
            array.iter().map(|value| value.as_inline_table().map(|table| reader(table))).collect()
        });
        inline.flatten().ok_or_else(|| self.error(key, item, "a table or a list of tables"))
    }

    /// A key that must be there.
    pub(crate) fn required<T>(&self, key: &str, value: Option<T>) -> anyhow::Result<T> {
        value.ok_or_else(|| {
            let start = self.table.iter().find_map(|(key, _)| self.table.key(key)?.span());
            let line = start.map_or(1, |span| line(self.file.document.raw(), span.start));
            anyhow!("{}: line {line}: `{key}` is missing in this table", self.file.place)
        })
    }

    /// Refuses keys that nobody asked for.
    pub(crate) fn finish(self) -> anyhow::Result<()> {
        let unknown = self.table.iter().find(|(key, _)| !self.known.contains(key));
        let Some((key, _)) = unknown else { return Ok(()) };
        let span = self.table.key(key).and_then(toml_edit::Key::span);
        let line = span.map_or(1, |span| line(self.file.document.raw(), span.start));
        let similarity = |name: &&str| strsim::normalized_damerau_levenshtein(key, name);
        let nearest = self.known.iter().copied().max_by(|a, b| similarity(a).total_cmp(&similarity(b)));
        let place = &self.file.place;
        match nearest.filter(|name| similarity(name) >= SIMILAR) {
            Some(name) => bail!("{place}: line {line}: unknown key `{key}`; did you mean `{name}`?"),
            None => bail!("{place}: line {line}: unknown key `{key}`; known are {}", self.known.join(", ")),
        }
    }
}

fn number(value: &Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|n| n as f64))
}

/// The line of a byte, from 1.
fn line(text: &str, byte: usize) -> usize {
    text.bytes().take(byte).filter(|b| *b == b'\n').count() + 1
}

/// What an item is, in a few words.
fn described(item: &Item) -> String {
    match item {
        Item::Value(Value::String(text)) => format!("\"{}\"", text.value()),
        Item::Value(Value::Integer(number)) => number.value().to_string(),
        Item::Value(Value::Float(number)) => number.value().to_string(),
        Item::Value(Value::Boolean(value)) => value.value().to_string(),
        Item::Value(Value::Array(array)) => format!("a list of {}", array.len()),
        _ => format!("a {}", item.type_name()),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests may panic")]
mod tests {
    use super::*;

    fn file(text: &str) -> SceneFile {
        SceneFile::parse(Path::new("s.toml"), text.to_owned()).unwrap()
    }

    #[test]
    fn values_are_read_and_wrong_ones_are_named_with_their_line() {
        let scene = file("dt = 1\nname = \"a\"\n\nat = [1, 2.5, 3]\n[[part]]\nn = 3\n");
        let mut top = scene.top();
        assert_eq!(top.number("dt").unwrap(), Some(1.0));
        assert_eq!(top.text("name").unwrap().as_deref(), Some("a"));
        assert_eq!(top.vector("at").unwrap(), Some([1.0, 2.5, 3.0]));
        assert_eq!(top.number("missing").unwrap(), None);
        let mut parts = top.tables("part").unwrap();
        assert_eq!(parts[0].count("n").unwrap(), Some(3));
        let wrong = scene.top().number("name").unwrap_err().to_string();
        assert_eq!(wrong, "s.toml: line 2: `name` is \"a\", expected a number");
        top.finish().unwrap();
        let missing = parts[0].required::<f64>("radius", None).unwrap_err().to_string();
        assert_eq!(missing, "s.toml: line 6: `radius` is missing in this table");
    }

    #[test]
    fn unknown_keys_are_named_with_the_nearest_one() {
        let scene = file("dt = 1\nviscosty = 0.1\n");
        let mut top = scene.top();
        top.number("dt").unwrap();
        top.number("viscosity").unwrap();
        let error = top.finish().unwrap_err().to_string();
        assert_eq!(error, "s.toml: line 2: unknown key `viscosty`; did you mean `viscosity`?");
        let Err(broken) = SceneFile::parse(Path::new("s.toml"), "dt = 1\nx = [1,".to_owned()) else {
            panic!("an open list")
        };
        assert!(broken.to_string().starts_with("s.toml: line 2: "), "{broken}");
    }
}
