// SPDX-License-Identifier: MIT
// What stands around the model, sized and placed as pictures have it (engine/overlay/legend.cpp).

const element = (id) => document.getElementById(id);
const css = (c, alpha = 1) => `rgb(${c.map((x) => Math.round(255 * x)).join(' ')} / ${alpha})`;
const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

function layOutLegend(scene, view, ink) {
  const { legend } = view;
  const line = Math.round(Math.max(13, Math.min(innerWidth, innerHeight) / 38));
  document.documentElement.style.setProperty('--line', line + 'px');
  element('caption').textContent = scene.caption;
  const keys = element('keys');
  keys.replaceChildren(...legend.keys.map((key) => {
    const row = document.createElement('div');
    const swatch = row.appendChild(document.createElement('div'));
    swatch.className = 'swatch';
    for (const colour of key.patches ?? [key.colour]) {
      const patch = swatch.appendChild(document.createElement('i'));
      patch.style.background = css(colour);
      if (!key.patches) patch.className = 'stroke';
      if (key.rim) patch.style.borderColor = css(key.rim);
    }
    row.append(key.label);
    return row;
  }));
  const [left, top, right, bottom] = legend.bar?.box ?? [0, 0, 0, 0];
  element('bar').hidden = right <= left;
  if (right <= left) return;
  const scale = line / legend.line;
  const [width, height] = scene.size;
  const tall = Math.min((bottom - top) * scale, 0.7 * innerHeight);
  const middle = (top + bottom) / 2 / height * innerHeight;
  const box = element('bar').style;
  box.left = innerWidth - (width - left) * scale + 'px';
  box.top = Math.round(middle - tall / 2) + 'px';
  box.height = Math.round(tall) + 'px';
  drawBar(legend.bar, scene.tables[view.table], ink, Math.round((right - left) * scale), Math.round(tall), line);
}

function drawBar(legend, colours, ink, width, height, line) {
  const bar = element('bar');
  const ratio = devicePixelRatio;
  bar.querySelector('.title').textContent = legend.title;
  const canvas = bar.querySelector('canvas');
  canvas.style.width = width + 'px';
  canvas.style.height = height + 'px';
  canvas.width = width * ratio;
  canvas.height = height * ratio;
  const context = canvas.getContext('2d');
  const table = bytesOf(colours);
  const steps = table.length / 3;
  for (let y = 0; y < canvas.height; ++y) {
    const i = 3 * clamp(Math.floor((1 - (y + 0.5) / canvas.height) * steps), 0, steps - 1);
    context.fillStyle = `rgb(${table[i]} ${table[i + 1]} ${table[i + 2]})`;
    context.fillRect(0, y, canvas.width, 1);
  }
  const stroke = Math.max(1, Math.round(line / 18)) * ratio;
  const topOf = (at) => clamp(Math.round(canvas.height * (1 - at) - stroke / 2), 0, canvas.height - stroke);
  const tops = legend.lines.map(topOf).sort((a, b) => a - b);
  if (tops.every((top, i) => i === 0 || top - tops[i - 1] >= 3 * stroke)) {
    context.fillStyle = css(ink, 0.55);
    for (const top of tops) context.fillRect(0, top, canvas.width, stroke);
  }
  context.strokeStyle = css(ink);
  context.lineWidth = stroke;
  context.strokeRect(stroke / 2, stroke / 2, canvas.width - stroke, canvas.height - stroke);
  let last = Infinity;
  bar.querySelector('.ticks').replaceChildren(...legend.ticks.flatMap(([at, label]) => {
    const top = (1 - at) * height;
    if (last - top < 0.9 * line) return [];  // they would touch
    last = top;
    const tick = document.createElement('div');
    tick.append(document.createElement('i'), label);
    tick.style.left = width + 'px';
    tick.style.top = top + 'px';
    return [tick];
  }));
}
