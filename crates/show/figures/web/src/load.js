// From the data of a page to what scenes and blocks are made of: arrays decoded, meshes, values, scales and players.

import { decode, spread } from "./decode.js";
import { Mesh } from "./mesh.js";
import { Player } from "./player.js";
import { polygonTriangles } from "./polygons.js";
import { Scale } from "./scale.js";
import { Values } from "./values.js";

async function meshOf(data, meshes, space) {
  if (data.kind === "moved") {
    const like = meshes[data.of];
    return new Mesh({ ...data, name: like.name, element: like.element, faceCount: like.faceCount, places: like.places, indices: like.indices, faces: like.faces,
      positions: spread(await decode(data.positions), like.places) });
  }
  if (data.kind === "polygons") return new Mesh({ ...data, faceCount: data.faces, ...polygonTriangles(data.polygons, space) });
  const places = await decode(data.places);
  return new Mesh({ ...data, faceCount: data.faces, places, positions: spread(await decode(data.positions), places), indices: await decode(data.indices),
    faces: data.triangleFaces && (await decode(data.triangleFaces)) });
}

/** Decodes the arrays of a shape in place. */
async function decodeShape(shape) {
  for (const name of ["points", "indices", "lengths", "values"]) {
    if (shape[name]?.data !== undefined) shape[name] = await decode(shape[name]);
  }
}

export async function load(data) {
  const meshes = [];
  for (const mesh of data.meshes) meshes.push(await meshOf(mesh, meshes, data.spaces[mesh.space]));
  const scales = data.scales.map((scale) => new Scale(scale));
  const values = [];
  for (const given of data.values) values.push(new Values({ ...given, scale: scales[given.scale], data: await decode(given.data) }));
  const bounds = [];
  for (const given of data.bounds) bounds.push(await decode(given.data));
  for (const scene of data.scenes) {
    for (const layer of scene.layers) for (const shape of layer.frames) await decodeShape(shape);
    for (const place of scene.places) place.faces = await decode(place.faces);
  }
  return { meshes, scales, values, bounds, players: data.players.map((player) => new Player(player)) };
}
