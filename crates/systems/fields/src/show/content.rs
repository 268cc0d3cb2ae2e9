//! The data of a page of tangent fields, and the page composed of generic blocks.

use pompeiu_figures::page::{
    Amount, Arrangement, Axis, Block, Card, Cell, Fact, Layer, Mesh, MeshValues, Page, PageError, Paint, Row,
    Scene, SceneId, Shape, Space, Statistic, Table, Text, ValueScale,
};

/// Tangent fields on one surface, shown side by side on one scale: typically a field and its parts.
///
/// The page computes nothing: norms, inner products and residuals come from the caller.
///
/// # Shapes and units
/// One vector for each face and field, in the coordinates of the surface. Norms are those of fields over the surface.
///
/// # Cost
/// The page takes 0.7 MB and some 30 bytes for each vector.
///
/// # Example
/// ```
/// use pompeiu_fields::show::{FieldsContent, NamedField};
///
/// let field = |label: &str, x: f64| NamedField { label: label.into(), vectors: vec![[x, 0.0, 0.0]], norm: x };
/// let content = FieldsContent {
///     title: "A field of one vector".into(),
///     corners: vec![[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]],
///     fields: vec![field("field", 1.0), field("gradient", 1.0), field("harmonic", 0.0)],
///     inner_products: vec![vec![0.5, 0.5, 0.0], vec![0.5, 0.5, 0.0], vec![0.0; 3]],
///     ..FieldsContent::default()
/// };
/// assert!(content.page()?.html().contains("A field of one vector"));
/// # Ok::<(), pompeiu_figures::page::PageError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FieldsContent {
    /// The title.
    pub title: String,
    /// The displayed unit of vectors; may be empty.
    pub unit: String,
    /// The axis that points up at first.
    pub up: Axis,
    /// The name of the surface's file.
    pub name: String,
    /// The file with its folder.
    pub path: String,
    /// Vertices of the surface.
    pub vertices: usize,
    /// Corners of each face.
    pub corners: Vec<[[f64; 3]; 3]>,
    /// The fields, in the order shown.
    pub fields: Vec<NamedField>,
    /// The inner products of all pairs of fields.
    pub inner_products: Vec<Vec<f64>>,
    /// The norm of the residual, the field minus its parts.
    pub residual: f64,
    /// More numbers, such as degrees of freedom.
    pub tables: Vec<TextTable>,
    /// Remarks, paragraph by paragraph.
    pub notes: Vec<String>,
    /// Further information on the run: names and values.
    pub facts: Vec<[String; 2]>,
    /// The command that reproduces this page.
    pub command: Option<String>,
    /// The version of the program.
    pub version: String,
}

/// A field that is constant on each face.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NamedField {
    /// The label.
    pub label: String,
    /// Its vector on each face.
    pub vectors: Vec<[f64; 3]>,
    /// Its norm over the surface.
    pub norm: f64,
}

/// A table of text.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TextTable {
    /// The caption.
    pub title: String,
    /// Column headings.
    pub head: Vec<String>,
    /// The rows; the first entry is the heading of the row.
    pub rows: Vec<Vec<String>>,
}

impl FieldsContent {
    /// The page, to be written with [`Page::html`].
    ///
    /// # Errors
    /// [`PageError`] if data is missing, inconsistent or not finite.
    pub fn page(&self) -> Result<Page, PageError> {
        if self.fields.is_empty() {
            return Err(PageError::NothingToShow);
        }
        let mut page = Page::new(self.title.clone());
        page.subtitle = Text::from(format!("{}, ", self.name)).count(self.corners.len(), "face");
        page.picture = "fields".into();
        page.command.clone_from(&self.command);
        page.version.clone_from(&self.version);
        let scenes = self.add_scenes(&mut page)?;
        self.add_arrangements(&mut page, &scenes)?;
        page.add_card(self.norms())?;
        page.add_card(self.products()?)?;
        for table in &self.tables {
            page.add_card(table.card())?;
        }
        page.add_card(self.facts())?;
        Ok(page)
    }

    /// A scene for each field, with one scale for all.
    fn add_scenes(&self, page: &mut Page) -> Result<Vec<SceneId>, PageError> {
        let space = page.add_space(Space::Spatial(self.up));
        let mesh = page.add_mesh(space, Mesh::from_corners(self.name.clone(), &self.corners))?;
        let scale = ValueScale {
            title: "length of vectors".into(),
            unit: self.unit.clone(),
            ..ValueScale::default()
        };
        let scale = page.add_scale(scale)?;
        let arrows = page.add_toggle("Arrows", true);
        let scene = |field: &NamedField| {
            let values = page.add_values(mesh, scale, MeshValues::vectors_on_faces(field.vectors.clone()))?;
            let mut scene = Scene::new(field.label.clone(), space);
            scene.layers = vec![
                Layer::new(Shape::Surface { mesh, paint: Paint::Values(values), bounds: None }),
                Layer::new(Shape::Arrows { mesh, vectors: values }).with_toggle(arrows),
            ];
            page.add_scene(scene)
        };
        self.fields.iter().map(scene).collect()
    }

    fn add_arrangements(&self, page: &mut Page, scenes: &[SceneId]) -> Result<(), PageError> {
        let arrangement = |key: String, text: &str, scenes: Vec<SceneId>| Arrangement {
            key,
            text: text.to_owned(),
            hint: String::new(),
            scenes,
        };
        if scenes.len() > 1 {
            page.add_arrangement(arrangement("all".into(), "All", scenes.to_vec()))?;
        }
        for (i, (scene, field)) in scenes.iter().zip(&self.fields).enumerate() {
            page.add_arrangement(arrangement(i.to_string(), &field.label, vec![*scene]))?;
        }
        Ok(())
    }

    fn norms(&self) -> Card {
        let row = |field: &NamedField| Row {
            cells: vec![
                Cell::text(field.label.as_str()),
                Cell::Bar { value: field.norm },
                Cell::Number { value: field.norm, digits: 6 },
            ],
            place: None,
        };
        let table = Table {
            key: "norms".into(),
            caption: "Norm of each field".into(),
            columns: vec![String::new(); 3],
            rows: self.fields.iter().map(row).collect(),
            sortable: false,
        };
        let rest = Statistic {
            key: "residual".into(),
            name: "What the parts leave over".into(),
            value: Amount::Number { number: self.residual, digits: 3 },
            ..Statistic::default()
        };
        Card::new("Norms", vec![Block::Table(table), Block::Statistics(vec![rest])])
    }

    fn products(&self) -> Result<Card, PageError> {
        let (what, expected) = ("the list of inner products", self.fields.len());
        if self.inner_products.len() != expected {
            return Err(PageError::Length { what, found: self.inner_products.len(), expected });
        }
        let row = |(field, products): (&NamedField, &Vec<f64>)| {
            let numbers = products.iter().map(|&value| Cell::Number { value, digits: 3 });
            let cells = std::iter::once(Cell::text(field.label.as_str())).chain(numbers).collect();
            Row { cells, place: None }
        };
        let labels = self.fields.iter().map(|field| field.label.clone());
        let table = Table {
            key: "inner-products".into(),
            caption: "Inner product of each field with each".into(),
            columns: std::iter::once(String::new()).chain(labels).collect(),
            rows: self.fields.iter().zip(&self.inner_products).map(row).collect(),
            sortable: false,
        };
        Ok(Card::new("Inner products", vec![Block::Table(table)]))
    }

    fn facts(&self) -> Card {
        let mut blocks: Vec<Block> =
            self.notes.iter().map(|note| Block::Note(note.as_str().into())).collect();
        let counts = Text::default().count(self.corners.len(), "face").text(", ").count(self.vertices, "");
        let surface =
            Fact { name: "surface".into(), value: self.path.as_str().into(), note: counts.text(" vertices") };
        let facts = self.facts.iter().map(|[name, value]| Fact::new(name, value.as_str()));
        blocks.push(Block::Facts(std::iter::once(surface).chain(facts).collect()));
        blocks.push(Block::Run);
        Card::new("Surface and run", blocks)
    }
}

impl TextTable {
    fn card(&self) -> Card {
        let row = |row: &Vec<String>| Row {
            cells: row.iter().map(|text| Cell::text(text.as_str())).collect(),
            place: None,
        };
        let table = Table {
            caption: self.title.clone(),
            columns: self.head.clone(),
            rows: self.rows.iter().map(row).collect(),
            ..Table::default()
        };
        Card::new(self.title.clone(), vec![Block::Table(table)])
    }
}
