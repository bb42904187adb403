// The data of the page: JSON, and tables of whole numbers packed as runs/walk/packed_numbers.h says.
"use strict";

function bytesOf(base64) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(base64);
  const text = atob(base64), bytes = new Uint8Array(text.length);
  for (let k = 0; k < bytes.length; ++k) bytes[k] = text.charCodeAt(k);
  return bytes;
}

async function inflated(bytes) {
  if (typeof DecompressionStream === "undefined") throw new Error("This page needs a newer browser: this one cannot unpack its data.");
  const stream = new Response(bytes).body.pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/// One table from its place on: differences from row to row, folded, byte by byte.
function readTable(bytes, place, table) {
  const { rows, columns } = table, length = rows * columns, values = new Int32Array(length);
  const highest = (table.bytes - 1) * length;
  for (let column = 0; column < columns; ++column) {
    let value = 0;
    for (let k = column, lowest = place + column * rows; k < length; k += columns, ++lowest) {
      let folded = 0;
      for (let at = lowest + highest; at >= lowest; at -= length) folded = folded << 8 | bytes[at];
      value = value + (folded >>> 1 ^ -(folded & 1)) | 0;
      values[k] = value;
    }
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

/// The tables of the page by name, those of light as bits of halves. `meanwhile` is done once they are inflated.
async function readTables(data, meanwhile = () => {}) {
  const bytes = await inflated(bytesOf(data.packed)), tables = {};
  meanwhile();
  let place = 0;
  for (const table of data.tables) {
    const values = readTable(bytes, place, table);
    tables[table.name] = /^(irradiance|lamp)/.test(table.name) ? halvesOfTable(values) : values;
    place += table.rows * table.columns * table.bytes;
  }
  return tables;
}

/// The numbers of finite halves (IEEE 754 binary16) by their bits: as those of floats of 32 bits, whose exponent counts from
/// 127 in place of 15.
function halvesToNumbers(bits) {
  const numbers = new Float32Array(bits.length), floats = new Uint32Array(numbers.buffer);
  for (let k = 0; k < bits.length; ++k) floats[k] = (bits[k] & 0x8000) << 16 | (bits[k] & 0x7fff) << 13;
  for (let k = 0; k < bits.length; ++k) numbers[k] *= 2 ** 112;
  return numbers;
}

/// An image that WebGL takes, its numbers as they are in the file.
async function readImage(address) {
  const [head, base64] = address.split(","), kind = head.slice(5).split(";")[0];
  return createImageBitmap(new Blob([bytesOf(base64)], { type: kind }),
    { premultiplyAlpha: "none", colorSpaceConversion: "none" });
}
