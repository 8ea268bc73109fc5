// SPDX-License-Identifier: MIT
// What the page holds, as numbers: the counterpart of PackedArrays (app/drawing/packed_arrays.h).

function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

async function inflated(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Differences, folded and in planes of bytes, as whole numbers; with a step as floats, where 0 is
// no value.
function unpacked(bytes, from, entry) {
  const { count, parts } = entry;
  const whole = new Uint32Array(count);
  for (let k = 0; k < entry.bytes; ++k) {
    const plane = from + k * count;
    for (let i = 0; i < count; ++i) whole[i] |= bytes[plane + i] << 8 * k;
  }
  for (let i = 0; i < count; ++i) {
    const difference = whole[i] >>> 1 ^ -(whole[i] & 1);
    whole[i] = difference + (i < parts ? 0 : whole[i - parts]);
  }
  if (entry.step === undefined) return whole;
  const floats = new Float32Array(count);
  for (let i = 0; i < count; ++i) {
    floats[i] = whole[i] === 0 ? NO_VALUE : entry.low + (whole[i] - 1) * entry.step;
  }
  return floats;
}

const NO_VALUE = -3.4028234663852886e38;

async function arraysOf(scene) {
  const element = document.getElementById('data');
  const bytes = await inflated(bytesOf(element.textContent));
  element.remove();
  const arrays = {};
  let from = 0;
  for (const entry of scene.arrays) {
    arrays[entry.name] = unpacked(bytes, from, entry);
    from += entry.bytes * entry.count;
  }
  return arrays;
}

// Normals from points on the unfolded octahedron; the last two of them only span the square.
function normalsOf(square) {
  const count = square.length / 2 - 2;
  const normals = new Float32Array(3 * count);
  for (let i = 0; i < count; ++i) {
    let x = square[2 * i], y = square[2 * i + 1];
    const z = 1 - Math.abs(x) - Math.abs(y);
    if (z < 0) {
      [x, y] = [(1 - Math.abs(y)) * (x >= 0 ? 1 : -1), (1 - Math.abs(x)) * (y >= 0 ? 1 : -1)];
    }
    const size = Math.hypot(x, y, z);
    normals.set([x / size, y / size, z / size], 3 * i);
  }
  return normals;
}

// Vectors of three numbers, and matrices by columns.
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const along = (a, s, b) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                         a[0] * b[1] - a[1] * b[0]];
const at3 = (array, i) => [array[3 * i], array[3 * i + 1], array[3 * i + 2]];

function times(a, b) {
  const out = new Float32Array(16);
  for (let c = 0; c < 4; ++c) {
    for (let r = 0; r < 4; ++r) {
      for (let k = 0; k < 4; ++k) out[4 * c + r] += a[4 * k + r] * b[4 * c + k];
    }
  }
  return out;
}
