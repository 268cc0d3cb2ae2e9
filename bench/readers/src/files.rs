//! The files that are read.

use std::io::{self, Write};

type Mesh<'a> = (&'a [[f64; 3]], &'a [[u32; 3]]);

/// OBJ, with six decimals as most programs write it or with every digit of the doubles.
pub fn obj((positions, faces): Mesh, digits: Option<usize>, out: &mut impl Write) -> io::Result<()> {
    for [x, y, z] in positions {
        match digits {
            Some(n) => writeln!(out, "v {x:.n$} {y:.n$} {z:.n$}")?,
            None => writeln!(out, "v {x} {y} {z}")?,
        }
    }
    for face in faces {
        let [a, b, c] = face.map(|i| i + 1);
        writeln!(out, "f {a} {b} {c}")?;
    }
    Ok(())
}

/// OBJ with texture and normal indices at every corner.
pub fn obj_with_normals((positions, faces): Mesh, out: &mut impl Write) -> io::Result<()> {
    for [x, y, z] in positions {
        writeln!(out, "v {x:.6} {y:.6} {z:.6}\nvn {x:.4} {y:.4} {z:.4}")?;
    }
    for face in faces {
        let [a, b, c] = face.map(|i| i + 1);
        writeln!(out, "f {a}//{a} {b}//{b} {c}//{c}")?;
    }
    Ok(())
}

/// Binary little-endian PLY with `float` or `double` coordinates.
pub fn ply((positions, faces): Mesh, double: bool, out: &mut impl Write) -> io::Result<()> {
    let kind = if double { "double" } else { "float" };
    write!(out, "ply\nformat binary_little_endian 1.0\nelement vertex {}\n", positions.len())?;
    write!(out, "property {kind} x\nproperty {kind} y\nproperty {kind} z\nelement face {}\n", faces.len())?;
    write!(out, "property list uchar int vertex_indices\nend_header\n")?;
    for &x in positions.as_flattened() {
        if double {
            out.write_all(&x.to_le_bytes())?;
        } else {
            out.write_all(&(x as f32).to_le_bytes())?;
        }
    }
    for face in faces {
        out.write_all(&[3])?;
        for i in face {
            out.write_all(&i.to_le_bytes())?;
        }
    }
    Ok(())
}

/// Ascii PLY.
pub fn ply_ascii((positions, faces): Mesh, out: &mut impl Write) -> io::Result<()> {
    write!(out, "ply\nformat ascii 1.0\nelement vertex {}\n", positions.len())?;
    write!(out, "property float x\nproperty float y\nproperty float z\nelement face {}\n", faces.len())?;
    write!(out, "property list uchar int vertex_indices\nend_header\n")?;
    rows((positions, faces), out)
}

/// Ascii OFF.
pub fn off((positions, faces): Mesh, out: &mut impl Write) -> io::Result<()> {
    write!(out, "OFF\n{} {} 0\n", positions.len(), faces.len())?;
    rows((positions, faces), out)
}

fn rows((positions, faces): Mesh, out: &mut impl Write) -> io::Result<()> {
    for [x, y, z] in positions {
        writeln!(out, "{x:.6} {y:.6} {z:.6}")?;
    }
    for [a, b, c] in faces {
        writeln!(out, "3 {a} {b} {c}")?;
    }
    Ok(())
}

/// Binary STL.
pub fn stl((positions, faces): Mesh, out: &mut impl Write) -> io::Result<()> {
    out.write_all(&[0; 80])?;
    out.write_all(&(faces.len() as u32).to_le_bytes())?;
    for face in faces {
        out.write_all(&[0; 12])?;
        for x in face.map(|i| positions[i as usize]).as_flattened() {
            out.write_all(&(*x as f32).to_le_bytes())?;
        }
        out.write_all(&[0; 2])?;
    }
    Ok(())
}
