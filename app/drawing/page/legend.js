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
  const heading = element('heading');
  heading.textContent = legend.heading;
  keys.style.marginTop = legend.heading ? '1.6em' : 0;
  // Words that would reach the buttons stand below them.
  const words = document.createRange();
  words.selectNodeContents(heading);
  const tools = element('tools').getBoundingClientRect();
  const meet = tools.width > 0 && words.getBoundingClientRect().right > tools.left;
  heading.style.top = meet ? tools.bottom + 'px' : '';
  const [left, top, right, bottom] = legend.bar?.box ?? [0, 0, 0, 0];
  element('bar').hidden = right <= left;
  if (right <= left) return;
  const scale = line / legend.line;
  const [width, height] = scene.size;
  const row = right - left > bottom - top;  // along the lower edge; else at the right side
  const room = row ? innerWidth - 4 * line : 0.7 * innerHeight;
  const length = Math.round(Math.min((row ? right - left : bottom - top) * scale, room));
  const thick = Math.round((row ? bottom - top : right - left) * scale);
  const box = element('bar').style;
  const middle = (top + bottom) / 2 / height * innerHeight;
  box.left = row ? Math.round((innerWidth - length) / 2) + 'px' : innerWidth - (width - left) * scale + 'px';
  box.top = (row ? innerHeight - (height - top) * scale : Math.round(middle - length / 2)) + 'px';
  box.height = (row ? thick : length) + 'px';
  element('bar').classList.toggle('row', row);
  drawBar(legend.bar, scene.tables[view.table], ink, row, length, thick, line);
}

// Along the bar from its lower end, across it: so it is drawn, whichever way it stands.
function drawBar(legend, colours, ink, row, length, thick, line) {
  const bar = element('bar');
  const tip = Math.round(0.6 * thick);  // of the arrows beyond its ends
  bar.querySelector('.title').textContent = legend.title;
  bar.querySelector('.title').style.marginBottom = (!row && legend.above ? tip : 0) + 'px';
  const canvas = bar.querySelector('canvas');
  const ratio = devicePixelRatio;
  const [wide, tall] = row ? [length + 2 * tip, thick] : [thick, length + 2 * tip];
  Object.assign(canvas.style, { width: wide + 'px', height: tall + 'px', position: 'absolute',
                                left: (row ? -tip : 0) + 'px', top: (row ? 0 : -tip) + 'px' });
  canvas.width = Math.round(wide * ratio);
  canvas.height = Math.round(tall * ratio);
  const context = canvas.getContext('2d');
  const [whole, across, end] = [length, thick, tip].map((x) => Math.round(x * ratio));
  if (row) context.setTransform(1, 0, 0, 1, end, 0);
  else context.setTransform(0, -1, 1, 0, 0, whole + end);
  const table = bytesOf(colours);
  const steps = table.length / 3;
  const colourAt = (step) => `rgb(${[0, 1, 2].map((k) => table[3 * clamp(step, 0, steps - 1) + k]).join(' ')})`;
  for (let i = 0; i < whole; ++i) {
    context.fillStyle = colourAt(Math.floor((i + 0.5) / whole * steps));
    context.fillRect(i, 0, 1, across);
  }
  const stroke = Math.max(1, Math.round(line / 18)) * ratio;
  const places = legend.lines.map((at) => clamp(Math.round(whole * at - stroke / 2), 0, whole - stroke))
    .sort((a, b) => a - b);
  if (places.every((place, i) => i === 0 || place - places[i - 1] >= 3 * stroke)) {
    context.fillStyle = css(ink, 0.55);
    for (const place of places) context.fillRect(place, 0, stroke, across);
  }
  context.strokeStyle = css(ink);
  context.lineWidth = stroke;
  context.strokeRect(stroke / 2, stroke / 2, whole - stroke, across - stroke);
  for (const [there, base, away, step] of [[legend.below, 0, -end, 0], [legend.above, whole, end, steps - 1]]) {
    if (!there) continue;
    context.beginPath();
    context.moveTo(base, stroke / 2);
    context.lineTo(base + away - Math.sign(away) * stroke, across / 2);
    context.lineTo(base, across - stroke / 2);
    context.closePath();
    context.fillStyle = colourAt(step);
    context.fill();
    context.stroke();
  }
  const room = (label) => row ? 0.7 * line * label.length + 0.6 * line : 0.9 * line;
  let last = -Infinity;
  bar.querySelector('.ticks').replaceChildren(...legend.ticks.flatMap(([at, label]) => {
    if (at * length - last < room(label)) return [];  // they would touch
    last = at * length;
    const tick = document.createElement('div');
    tick.append(document.createElement('i'), label);
    tick.style.left = (row ? at * length : thick) + 'px';
    tick.style.top = (row ? thick : (1 - at) * length) + 'px';
    return [tick];
  }));
}
