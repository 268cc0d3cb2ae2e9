//! Pages of fields: rejected input.

use pompeiu_fields::show::{FieldsContent, NamedField};
use pompeiu_figures::page::PageError;

#[test]
fn fields_that_do_not_belong_together_are_refused() {
    let page = FieldsContent {
        corners: vec![[[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]]],
        fields: vec![NamedField { label: "</script>".into(), vectors: vec![[1.0, 0.0, 0.0]], norm: 1.0 }],
        inner_products: vec![vec![1.0]],
        ..FieldsContent::default()
    };
    let html = page.page().unwrap().html();
    assert_eq!(html.matches("<script").count(), html.matches("</script>").count());
    let refused = |spoil: fn(&mut FieldsContent)| {
        let mut page = page.clone();
        spoil(&mut page);
        page.page().unwrap_err()
    };
    assert!(matches!(
        refused(|p| p.fields[0].vectors[0][1] = f64::NAN),
        PageError::NonFinite { index: 1, .. }
    ));
    assert!(matches!(refused(|p| p.fields[0].norm = f64::INFINITY), PageError::NonFinite { .. }));
    assert!(matches!(refused(|p| p.residual = f64::NAN), PageError::NonFinite { .. }));
    assert!(matches!(refused(|p| p.corners[0][0][0] = f64::NAN), PageError::NonFinite { .. }));
    let error = refused(|p| p.fields[0].vectors.clear());
    assert!(matches!(error, PageError::Length { found: 0, expected: 3, .. }), "{error:?}");
    assert!(matches!(refused(|p| p.inner_products[0].push(0.0)), PageError::Length { .. }));
    assert_eq!(refused(|p| p.corners.clear()), PageError::NoTriangles { mesh: 0 });
    assert_eq!(refused(|p| p.fields.clear()), PageError::NothingToShow);
}
