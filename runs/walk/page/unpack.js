// The data of the page: JSON, and tables of whole numbers packed as runs/walk/packed_numbers.h says.
"use strict";

function bytesOf(base64) {
  const text = atob(base64), bytes = new Uint8Array(text.length);
  for (let k = 0; k < bytes.length; ++k) bytes[k] = text.charCodeAt(k);
  return bytes;
}

async function inflated(bytes) {
  if (typeof DecompressionStream === "undefined") throw new Error("This page needs a newer browser: this one cannot unpack its data.");
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/// One table from its place on: differences from row to row, folded, byte by byte.
function readTable(bytes, place, table) {
  const { rows, columns } = table, values = new Int32Array(rows * columns);
  for (let byte = 0; byte < table.bytes; ++byte)
    for (let column = 0; column < columns; ++column)
      for (let k = column; k < values.length; k += columns)
        values[k] |= bytes[place++] << (8 * byte);
  for (let k = 0; k < values.length; ++k) {
    const folded = values[k], difference = folded & 1 ? ~(folded >>> 1) : folded >>> 1;
    values[k] = difference + (k < columns ? 0 : values[k - columns]);
  }
  return values;
}

/// Bits of halves, from a table of green and of red and blue less green.
function halvesOfTable(table) {
  const halves = new Uint16Array(table.length);
  for (let k = 0; k < table.length; k += 3) {
    halves[k] = table[k] + table[k + 1];
    halves[k + 1] = table[k];
    halves[k + 2] = table[k] + table[k + 2];
  }
  return halves;
}

/// The tables of the page by name, those of light as bits of halves.
async function readTables(data) {
  const bytes = await inflated(bytesOf(data.packed)), tables = {};
  let place = 0;
  for (const table of data.tables) {
    const values = readTable(bytes, place, table);
    tables[table.name] = /^(irradiance|lamp)/.test(table.name) ? halvesOfTable(values) : values;
    place += table.rows * table.columns * table.bytes;
  }
  return tables;
}

/// IEEE 754 binary16.
function halfToNumber(bits) {
  const sign = bits & 0x8000 ? -1 : 1, exponent = (bits >> 10) & 31, fraction = bits & 1023;
  if (exponent === 0) return sign * fraction * 2 ** -24;
  return exponent === 31 ? sign * Infinity : sign * (1 + fraction / 1024) * 2 ** (exponent - 15);
}

/// An image that WebGL takes, its numbers as they are in the file.
async function readImage(address) {
  const [head, base64] = address.split(","), kind = head.slice(5).split(";")[0];
  return createImageBitmap(new Blob([bytesOf(base64)], { type: kind }),
    { premultiplyAlpha: "none", colorSpaceConversion: "none" });
}
