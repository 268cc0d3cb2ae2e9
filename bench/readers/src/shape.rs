//! The mesh that is read: a subdivided icosahedron with noise along the radius.

/// Positions and faces of a sphere whose faces were split into four `levels` times.
pub fn noisy_sphere(levels: u32) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let golden = f64::midpoint(1.0, 5.0_f64.sqrt());
    let mut positions: Vec<[f64; 3]> = Vec::new();
    for (s, t) in [(-1.0, golden), (1.0, golden), (-1.0, -golden), (1.0, -golden)] {
        positions.push([s, t, 0.0]);
    }
    for (s, t) in [(-1.0, golden), (1.0, golden), (-1.0, -golden), (1.0, -golden)] {
        positions.push([0.0, s, t]);
    }
    for (s, t) in [(golden, -1.0), (golden, 1.0), (-golden, -1.0), (-golden, 1.0)] {
        positions.push([s, 0.0, t]);
    }
    let mut faces: Vec<[u32; 3]> = vec![
        [0, 11, 5],
        [0, 5, 1],
        [0, 1, 7],
        [0, 7, 10],
        [0, 10, 11],
        [1, 5, 9],
        [5, 11, 4],
        [11, 10, 2],
        [10, 7, 6],
        [7, 1, 8],
        [3, 9, 4],
        [3, 4, 2],
        [3, 2, 6],
        [3, 6, 8],
        [3, 8, 9],
        [4, 9, 5],
        [2, 4, 11],
        [6, 2, 10],
        [8, 6, 7],
        [9, 8, 1],
    ];
    for _ in 0..levels {
        let mut middles = std::collections::HashMap::new();
        let mut finer = Vec::with_capacity(4 * faces.len());
        for [a, b, c] in faces {
            let [ab, bc, ca] = [(a, b), (b, c), (c, a)].map(|(i, j)| {
                *middles.entry((i.min(j), i.max(j))).or_insert_with(|| {
                    let (p, q) = (positions[i as usize], positions[j as usize]);
                    positions.push([0, 1, 2].map(|k| f64::midpoint(p[k], q[k])));
                    positions.len() as u32 - 1
                })
            });
            finer.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        faces = finer;
    }
    let mut state = 1_u64;
    for p in &mut positions {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let noise = 1.0 + 1e-3 * ((state >> 33) as f64 / f64::from(1_u32 << 31) - 0.5);
        let length = p.iter().map(|x| x * x).sum::<f64>().sqrt();
        *p = p.map(|x| x / length * noise);
    }
    (positions, faces)
}

/// The faces in an order that has nothing to do with their place.
pub fn shuffled(faces: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let mut faces = faces.to_vec();
    let mut state = 2_u64;
    for i in (1..faces.len()).rev() {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        faces.swap(i, ((state >> 33) as usize) % (i + 1));
    }
    faces
}
