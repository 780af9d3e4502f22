"use strict";
// Pictures of fields: from the bytes of the monitor to values at the pixels of a canvas. No state is kept here.

const LEVELS = 65534; // from the lowest to the highest level of a picture; 0 is no value

// The pictures of one answer of api/pictures (monitor/web/gallery.hpp says how they lie in it).
function decode(buffer) {
  const view = new DataView(buffer), pictures = [];
  for (let place = 0; place < buffer.byteLength;) {
    const length = view.getUint32(place, true);
    const picture = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, place + 4, length)));
    place += 4 + length;
    picture.bytes = 0;
    for (const grid of picture.grids) {
      const samples = grid.n1 * grid.n2, positions = grid.straight ? grid.n1 + grid.n2 : 2 * samples;
      grid.x = new Float32Array(buffer.slice(place, place + 4 * positions));
      place += 4 * positions;
      grid.level = new Uint16Array(buffer.slice(place, place + 2 * samples));
      place += 4 * Math.ceil(samples / 2);
      picture.bytes += 4 * positions + 2 * samples;
    }
    pictures.push(picture);
  }
  return pictures;
}

function valueOf(picture, level) {
  return picture.low + ((level - 1) / LEVELS) * (picture.high - picture.low);
}

// Position of sample (i, j).
function positionOf(grid, i, j) {
  if (grid.straight) return [grid.x[i], grid.x[grid.n1 + j]];
  const k = j * grid.n1 + i;
  return [grid.x[k], grid.x[grid.n1 * grid.n2 + k]];
}

// Smallest rectangle [x1 low, x1 high, x2 low, x2 high] around pictures; null without any.
function extentOf(pictures) {
  const box = [Infinity, -Infinity, Infinity, -Infinity];
  for (const grid of pictures.flatMap((picture) => picture.grids)) {
    const middle = grid.straight ? grid.n1 : grid.n1 * grid.n2;
    for (let k = 0; k < grid.x.length; ++k) {
      const c = k < middle ? 0 : 2;
      if (grid.x[k] < box[c]) box[c] = grid.x[k];
      if (grid.x[k] > box[c + 1]) box[c + 1] = grid.x[k];
    }
  }
  return box[0] <= box[1] ? box : null;
}

// The rim of a solid, as curves: around its only grid, or of several those of rings, of which the wider side lies outside.
function rimsOf(picture) {
  const line = (grid, points) => ({ n1: points.length, n2: 1, straight: false, x: Float32Array.from([...points.map((one) => one[0]), ...points.map((one) => one[1])]) });
  const along = (grid, j) => Array.from({ length: grid.n1 }, (_, i) => positionOf(grid, i, j)), up = (grid, i) => Array.from({ length: grid.n2 }, (_, j) => positionOf(grid, i, j));
  const width = (points) => Math.max(...points.map((one) => one[0])) - Math.min(...points.map((one) => one[0]));
  const closes = (grid) => { const points = along(grid, 0), [a, b] = [points[0], points[grid.n1 - 1]]; return Math.hypot(a[0] - b[0], a[1] - b[1]) < 1e-4 * width(points); };
  return picture.grids.flatMap((grid) => {
    if (!grid.straight && closes(grid)) return [line(grid, [along(grid, 0), along(grid, grid.n2 - 1)].sort((a, b) => width(b) - width(a))[0])];
    return picture.grids.length > 1 ? [] : [line(grid, [...along(grid, 0), ...up(grid, grid.n1 - 1), ...along(grid, grid.n2 - 1).reverse(), ...up(grid, 0).reverse()])];
  });
}

// How the plane lies on a raster: a rectangle of it in the middle, with equal scales.
function viewOf(box, width, height) {
  const across = Math.max(box[1] - box[0], 1e-300), up = Math.max(box[3] - box[2], 1e-300);
  const unit = Math.min(width / across, height / up);
  return { unit, left: (box[0] + box[1]) / 2 - width / 2 / unit, top: (box[2] + box[3]) / 2 + height / 2 / unit };
}

function toRaster(view, x, y) {
  return [(x - view.left) * view.unit, (view.top - y) * view.unit];
}

// Values at the pixels, and the number of the picture they come from (0: none).
function makeRaster(width, height) {
  return { width, height, value: new Float32Array(width * height), owner: new Uint8Array(width * height) };
}

// Draws a picture over what is there, as number `owner`.
function rasterise(raster, picture, view, owner) {
  for (const grid of picture.grids) {
    if (grid.n1 < 2 || grid.n2 < 2) continue;
    if (grid.straight) fillStraight(raster, picture, grid, view, owner); else fillCurved(raster, picture, grid, view, owner);
  }
}

// For each pixel along an axis, between which samples it lies: [index, part]; index -1 outside.
function placesAlong(marks, count, at) {
  const index = new Int32Array(count).fill(-1), part = new Float32Array(count), rising = marks[marks.length - 1] > marks[0];
  for (let pixel = 0; pixel < count; ++pixel) {
    const x = at(pixel + 0.5);
    let low = 0, high = marks.length - 1;
    if (rising ? x < marks[low] || x > marks[high] : x > marks[low] || x < marks[high]) continue;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (rising === marks[middle] <= x) low = middle; else high = middle;
    }
    index[pixel] = low;
    part[pixel] = (x - marks[low]) / (marks[high] - marks[low]);
  }
  return { index, part };
}

function fillStraight(raster, picture, grid, view, owner) {
  const along = placesAlong(grid.x.subarray(0, grid.n1), raster.width, (pixel) => view.left + pixel / view.unit);
  const up = placesAlong(grid.x.subarray(grid.n1), raster.height, (pixel) => view.top - pixel / view.unit);
  const scale = (picture.high - picture.low) / LEVELS, base = picture.low - scale;
  for (let y = 0; y < raster.height; ++y) {
    if (up.index[y] < 0) continue;
    const b = up.part[y], row = up.index[y] * grid.n1;
    for (let x = 0; x < raster.width; ++x) {
      if (along.index[x] < 0) continue;
      const k = row + along.index[x], a = along.part[x];
      const p = grid.level[k], q = grid.level[k + 1], r = grid.level[k + grid.n1], s = grid.level[k + grid.n1 + 1];
      if (!p || !q || !r || !s) continue;
      raster.value[y * raster.width + x] = base + scale * ((1 - b) * ((1 - a) * p + a * q) + b * ((1 - a) * r + a * s));
      raster.owner[y * raster.width + x] = owner;
    }
  }
}

function fillCurved(raster, picture, grid, view, owner) {
  const n = grid.n1 * grid.n2, px = new Float32Array(n), py = new Float32Array(n), value = new Float32Array(n);
  for (let k = 0; k < n; ++k) {
    px[k] = (grid.x[k] - view.left) * view.unit;
    py[k] = (view.top - grid.x[n + k]) * view.unit;
    value[k] = valueOf(picture, grid.level[k]);
  }
  const corner = (k) => [px[k], py[k], value[k]];
  for (let j = 0; j + 1 < grid.n2; ++j) {
    for (let i = 0; i + 1 < grid.n1; ++i) {
      const k = j * grid.n1 + i;
      if (!grid.level[k] || !grid.level[k + 1] || !grid.level[k + grid.n1] || !grid.level[k + grid.n1 + 1]) continue;
      fillTriangle(raster, corner(k), corner(k + 1), corner(k + grid.n1), owner);
      fillTriangle(raster, corner(k + grid.n1 + 1), corner(k + 1), corner(k + grid.n1), owner);
    }
  }
}

// Linear between its corners [x, y, value]. Pixels whose centre lies inside or on the edge.
function fillTriangle(raster, a, b, c, owner) {
  const area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  if (area === 0) return;
  const left = Math.max(0, Math.ceil(Math.min(a[0], b[0], c[0]) - 0.5)), right = Math.min(raster.width - 1, Math.floor(Math.max(a[0], b[0], c[0]) - 0.5));
  const top = Math.max(0, Math.ceil(Math.min(a[1], b[1], c[1]) - 0.5)), bottom = Math.min(raster.height - 1, Math.floor(Math.max(a[1], b[1], c[1]) - 0.5));
  for (let y = top; y <= bottom; ++y) {
    for (let x = left; x <= right; ++x) {
      const s = ((x + 0.5 - a[0]) * (c[1] - a[1]) - (y + 0.5 - a[1]) * (c[0] - a[0])) / area;
      const t = ((b[0] - a[0]) * (y + 0.5 - a[1]) - (b[1] - a[1]) * (x + 0.5 - a[0])) / area;
      if (s < -1e-6 || t < -1e-6 || s + t > 1 + 1e-6) continue;
      raster.value[y * raster.width + x] = a[2] + s * (b[2] - a[2]) + t * (c[2] - a[2]);
      raster.owner[y * raster.width + x] = owner;
    }
  }
}

// ---- colours

const MAPS = {
  gas: [[68, 1, 84], [72, 40, 120], [62, 74, 137], [49, 104, 142], [38, 130, 142], [31, 158, 137], [53, 183, 121], [110, 206, 88], [181, 222, 43], [253, 231, 37]],
  solid: [[13, 8, 135], [84, 2, 163], [139, 10, 165], [185, 50, 137], [219, 92, 104], [244, 136, 73], [254, 188, 43], [240, 249, 33]],
};
const STRENGTH = 12; // of numerical schlieren: grey is exp(-STRENGTH |grad rho| / largest)

// Colour [red, green, blue] of a part of the way from the lowest to the highest value.
function mapped(map, part) {
  const within = Math.min(Math.max(part, 0), 1);
  if (map === "schlieren") return new Array(3).fill(Math.round(255 * Math.exp(-STRENGTH * within)));
  const colours = MAPS[map], place = within * (colours.length - 1), k = Math.min(Math.floor(place), colours.length - 2);
  return colours[k].map((c, i) => Math.round(c + (place - k) * (colours[k + 1][i] - c)));
}

// 256 colours as they lie in the memory of an image.
function tableOf(map) {
  const table = new Uint32Array(256), bytes = new Uint8Array(table.buffer);
  for (let k = 0; k < 256; ++k) bytes.set([...mapped(map, k / 255), 255], 4 * k);
  return table;
}

// Image of a raster. scales: for each owner {table, low, high}.
function imageOf(raster, scales) {
  const image = new ImageData(raster.width, raster.height), pixels = new Uint32Array(image.data.buffer);
  for (let k = 0; k < pixels.length; ++k) {
    if (!raster.owner[k]) continue;
    const { table, low, high } = scales[raster.owner[k]];
    const part = high > low ? (raster.value[k] - low) / (high - low) : 0;
    pixels[k] = table[part <= 0 ? 0 : part >= 1 ? 255 : Math.round(255 * part)];
  }
  return image;
}

// ---- lines over a picture

// Lines of component grids: those of the samples, but at most about `most` in each direction.
function drawGridLines(pen, picture, place, most) {
  for (const grid of picture.grids) {
    if (grid.n2 < 2) continue;
    const line = (count, index) => {
      let drawing = false;
      for (let k = 0; k < count; ++k) {
        const [i, j] = index(k);
        const at = place(...positionOf(grid, i, j));
        if (!grid.level[j * grid.n1 + i]) { drawing = false; continue; }
        if (drawing) pen.lineTo(...at); else pen.moveTo(...at);
        drawing = true;
      }
    };
    const shown = (n) => Array.from({ length: n }, (_, k) => k).filter((k) => k % Math.ceil(n / most) === 0 || k === n - 1);
    for (const j of shown(grid.n2)) line(grid.n1, (k) => [k, j]);
    for (const i of shown(grid.n1)) line(grid.n2, (k) => [i, k]);
  }
}

function drawOutlines(pen, picture, place) {
  for (const grid of picture.grids) {
    for (let i = 0; i < grid.n1; ++i) {
      const at = place(...positionOf(grid, i, 0));
      if (i) pen.lineTo(...at); else pen.moveTo(...at);
    }
  }
}
