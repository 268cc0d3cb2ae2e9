// Colours: those of the maps and of the style sheet, in sRGB from the table to the screen.

import { Color, DataTexture, LinearFilter, RGBAFormat, UnsignedByteType } from "three";

/** A colour as style sheets write it. */
export function raw(color) {
  return new Color().setStyle(color, "srgb-linear");
}

export function colorTexture(table) {
  const entries = table.length / 3;
  const bytes = new Uint8Array(4 * entries).fill(255);
  for (let i = 0; i < entries; i++) bytes.set(table.subarray(3 * i, 3 * i + 3), 4 * i);
  const texture = new DataTexture(bytes, entries, 1, RGBAFormat, UnsignedByteType);
  texture.magFilter = texture.minFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}
