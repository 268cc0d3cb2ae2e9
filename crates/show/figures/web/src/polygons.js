// Polygons as triangles: each polygon is a face.

import { ShapeUtils, Vector2 } from "three";

export function polygonTriangles(polygons, { origin, scale }) {
  const [positions, indices, faces] = [[], [], []];
  polygons.forEach(({ outer, holes }, face) => {
    const rings = [outer, ...holes].map((ring) => ring.map(([x, y]) => new Vector2((x - origin[0]) / scale, (y - origin[1]) / scale)));
    const base = positions.length / 3;
    for (const triangle of ShapeUtils.triangulateShape(rings[0], rings.slice(1))) {
      indices.push(...triangle.map((i) => base + i));
      faces.push(face);
    }
    for (const point of rings.flat()) positions.push(point.x, point.y, -origin[2] / scale);
  });
  const places = Uint32Array.from({ length: positions.length / 3 }, (_, i) => i);
  return { positions: Float32Array.from(positions), indices: Uint32Array.from(indices), faces: Uint32Array.from(faces), places };
}
