// SPDX-License-Identifier: MIT
// The page itself: camera, what is read off, mouse, touch and keys.

// Turns of the first three rows and columns of a view about an axis of the eye or of the scene.
function rotation(axis, angle) {
  const [x, y, z] = axis, c = Math.cos(angle), s = Math.sin(angle), d = 1 - c;
  return [c + x * x * d, y * x * d + z * s, z * x * d - y * s, 0,
          x * y * d - z * s, c + y * y * d, z * y * d + x * s, 0,
          x * z * d + y * s, y * z * d - x * s, c + z * z * d, 0, 0, 0, 0, 1];
}

class Page {
  constructor(scene, arrays) {
    Object.assign(this, { scene, arrays, canvas: element('picture'), first: scene.camera });
    this.painter = new Painter(this.canvas, scene, arrays);
    this.look();
    this.makeTools();
    this.view = scene.views.find((view) => view.name === scene.asked);
    this.paint(scene.background);
    this.show(this.view);
    this.listen();
    new ResizeObserver(() => this.refresh(true)).observe(document.body);
    this.canvas.addEventListener('webglcontextlost', (e) => e.preventDefault());
    this.canvas.addEventListener('webglcontextrestored', () => {
      this.painter = new Painter(this.canvas, scene, arrays);
      this.refresh();
    });
  }

  // The camera of the picture: a rotation, an eye that stays before the model, and a lens.
  look() {
    const { view } = this.first;
    this.turn = [...view.slice(0, 12), 0, 0, 0, 1];
    this.eye = [-view[12], -view[13], -view[14]];
    this.zoom = 1;
    this.pan = [0, 0];  // in heights of the picture
  }

  // CSS pixels of a pixel of the picture as it was asked for, which is seen whole.
  get fit() {
    const [width, height] = this.scene.size;
    return Math.min(innerWidth / width, innerHeight / height);
  }

  get widths() {
    const side = Math.max(Math.min(innerWidth, innerHeight) / 720, 0.75);
    return side * devicePixelRatio / this.scene.pixel_scale;
  }

  camera() {
    const { first, eye, fit } = this;
    const ratio = devicePixelRatio;
    const extent = [this.canvas.width, this.canvas.height];
    const pixels = first.pixels * fit * this.zoom * ratio;
    const height = this.scene.size[1] * fit * ratio;
    const axis = [first.axis[0] * fit * ratio + this.pan[0] * height,
                  first.axis[1] * fit * ratio - this.pan[1] * height];
    const view = [...this.turn];
    view[12] = -eye[0];
    view[13] = -eye[1];
    view[14] = -eye[2];
    // Vulkan's: y down, depth 1 near and 0 far (engine/scene/camera.cpp).
    const reach = 1.03, far = eye[2] + reach;
    const near = first.orthographic ? eye[2] - reach : Math.max(eye[2] - reach, 0.02);
    const length = far - near;
    const projection = new Float32Array(16);
    projection[0] = 2 * pixels / extent[0];
    projection[5] = -2 * pixels / extent[1];
    const shift = [2 * axis[0] / extent[0], 2 * axis[1] / extent[1]];
    if (first.orthographic) {
      projection[10] = 1 / length;
      projection.set([...shift, far / length, 1], 12);
    } else {
      projection.set([-shift[0], -shift[1], near / length, -1], 8);
      projection[14] = near * far / length;
    }
    return { view, projection, extent, pixels, orthographic: first.orthographic, axis };
  }

  refresh(resized = false) {
    this.resized ||= resized;
    if (this.waiting) return;
    this.waiting = true;
    const draw = () => {
      this.waiting = false;
      if (this.resized) this.layOut();
      this.resized = false;
      const { colour } = this.scene.backgrounds[this.background];
      this.painter.draw(this.view, this.camera(), colour, this.widths);
      this.placePin();
    };
    // At once where nothing has been drawn: a picture is taken of pages as soon as they are there.
    if (this.drawn) requestAnimationFrame(draw); else draw();
    this.drawn = true;
  }

  layOut() {
    this.canvas.width = Math.round(innerWidth * devicePixelRatio);
    this.canvas.height = Math.round(innerHeight * devicePixelRatio);
    layOutLegend(this.scene, this.view, this.ink);
  }

  show(view) {
    this.view = view;
    for (const button of element('tools').querySelectorAll('[data-view]')) {
      button.setAttribute('aria-pressed', button.dataset.view === view.name);
    }
    this.refresh(true);
  }

  paint(background) {
    this.background = background;
    const { colour, ink } = this.scene.backgrounds[background];
    const root = document.documentElement.style;
    document.body.style.background = colour[3] > 0 ? css(colour.slice(0, 3)) : 'none';
    root.setProperty('--ink', css(ink));
    root.setProperty('--paper', css(colour.slice(0, 3), 0.75 * colour[3]));
    root.setProperty('--card', css(ink[0] > 0.5 ? [0.17, 0.18, 0.21] : [1, 1, 1], 0.96));
    root.setProperty('color-scheme', ink[0] > 0.5 ? 'dark' : 'light');
    this.ink = ink;
    this.refresh(true);
  }

  makeTools() {
    const tools = element('tools');
    const add = (text, title, action) => {
      const button = tools.appendChild(document.createElement('button'));
      button.textContent = text;
      button.title = title;
      button.addEventListener('click', action);
      return button;
    };
    this.scene.views.forEach((view, i) => {
      add(view.name, `${view.name} (${i + 1})`, () => this.show(view)).dataset.view = view.name;
    });
    tools.appendChild(document.createElement('span')).className = 'gap';
    this.actions = {
      f: () => { this.look(); this.refresh(); },
      b: () => this.paint(this.background === 'dark' ? 'light' : 'dark'),
      '?': () => { element('help').hidden = !element('help').hidden; },
    };
    add('reset', 'back to the first look (f)', this.actions.f);
    add('light/dark', 'the background (b)', this.actions.b);
    add('?', 'mouse and keys', this.actions['?']);
  }

  rotate(right, up) {
    // About the vertical axis of the scene and the eye's own; never over the poles.
    const steep = Math.asin(clamp(this.turn[6], -1, 1));
    const tilt = clamp(steep + up, -Math.PI / 2, Math.PI / 2) - steep;
    this.turn = [...times(times(rotation([1, 0, 0], tilt), this.turn), rotation([0, 1, 0], right))];
    this.refresh();
  }

  // The point under (x, y), CSS pixels, stays where it is.
  zoomBy(factor, x = innerWidth / 2, y = innerHeight / 2) {
    const zoom = clamp(this.zoom * factor, 0.05, 2000);
    const by = zoom / this.zoom;
    const { axis, extent } = this.camera();
    const height = this.scene.size[1] * this.fit * devicePixelRatio;
    const away = [x * devicePixelRatio - extent[0] / 2 - axis[0], y * devicePixelRatio - extent[1] / 2 - axis[1]];
    this.pan[0] += away[0] * (1 - by) / height;
    this.pan[1] -= away[1] * (1 - by) / height;
    this.zoom = zoom;
    this.refresh();
  }

  move(dx, dy) {
    const height = this.scene.size[1] * this.fit;
    this.pan[0] += dx / height;
    this.pan[1] -= dy / height;
    this.refresh();
  }

  // The value, the next vertex of the model and the place under a point of the screen.
  read(x, y) {
    const { scene, arrays, view } = this;
    const ratio = devicePixelRatio;
    const hit = this.painter.hit(x * ratio, y * ratio, this.camera());
    if (!hit) return null;
    const corners = [0, 1, 2].map((k) => arrays.faces[3 * hit.face + k]);
    const place = [0, 1, 2].map((k) =>
      corners.reduce((sum, v, i) => sum + hit.weights[i] * arrays.positions[3 * v + k], 0));
    const ids = corners.map((v) => arrays.origin[v]);
    const nearest = ids[hit.weights.indexOf(Math.max(...hit.weights))];
    const known = ids.every((v) => arrays.values[v] > 0.9 * NO_VALUE);
    let value = arrays.values.length === 0 ? null : !known ? NaN :
      scene.value.base + scene.value.unit * ids.reduce((sum, v, i) => sum + hit.weights[i] * arrays.values[v], 0);
    let title = scene.value.title;
    if (view.paint === 'faces') {
      const own = arrays.face_values[hit.face];
      [value, title] = [own > 0.9 * NO_VALUE ? own : NaN, scene.face_title];
    }
    const model = place.map((p, k) => scene.centre[k] + scene.model_per_scene * p);
    return { place, value, title, model, vertex: nearest < scene.vertices ? nearest : null };
  }

  tell(found, x, y) {
    const box = element('value');
    box.hidden = !found;
    if (!found) return;
    const number = (v) => String(Number(v.toPrecision(5)));
    const value = document.createElement('b');
    if (found.value !== null) value.textContent = Number.isNaN(found.value) ? 'not reached' : number(found.value);
    const rows = [found.value === null ? '' : found.title, found.vertex === null ? '' : 'vertex ' + found.vertex,
                  found.model.map(number).join(', ')];
    box.replaceChildren(value, ...rows.filter(Boolean).map((text) => {
      const row = document.createElement('div').appendChild(document.createElement('span'));
      row.textContent = text;
      return row.parentNode;
    }));
    const beside = x + 16 + box.offsetWidth > innerWidth ? x - 16 - box.offsetWidth : x + 16;
    box.style.left = Math.max(4, beside) + 'px';
    box.style.top = clamp(y + 12, 4, innerHeight - box.offsetHeight - 4) + 'px';
  }

  placePin() {
    const pin = element('pin');
    pin.hidden = !this.pinned;
    if (!this.pinned) return;
    const { view, projection } = this.camera();
    const clip = times(projection, view), p = this.pinned.place;
    const [x, y, w] = [0, 1, 3].map((r) => clip[r] * p[0] + clip[4 + r] * p[1] + clip[8 + r] * p[2] + clip[12 + r]);
    const left = (x / w + 1) / 2 * innerWidth, top = (y / w + 1) / 2 * innerHeight;
    pin.style.left = left + 'px';
    pin.style.top = top + 'px';
    this.tell(this.pinned, left, top);
  }

  listen() {
    const { canvas } = this;
    const pointers = new Map();
    let travelled = 0;
    const spread = () => {
      const [a, b] = [...pointers.values()];
      return { size: Math.hypot(a.x - b.x, a.y - b.y), x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 };
    };
    canvas.addEventListener('pointerdown', (e) => {
      canvas.setPointerCapture(e.pointerId);
      pointers.set(e.pointerId, { x: e.clientX, y: e.clientY });
      if (pointers.size === 1) travelled = 0;
      canvas.classList.add('turning');
      element('help').hidden = true;
    });
    canvas.addEventListener('pointermove', (e) => {
      const before = pointers.get(e.pointerId);
      if (!before) return this.hover(e);
      const dx = e.clientX - before.x, dy = e.clientY - before.y;
      const two = pointers.size === 2 ? spread() : null;
      pointers.set(e.pointerId, { x: e.clientX, y: e.clientY });
      travelled += Math.hypot(dx, dy);
      if (two) {
        const now = spread();
        this.zoomBy(now.size / two.size, now.x, now.y);
        this.move(now.x - two.x, now.y - two.y);
      } else if (travelled > 3) {
        if (!this.pinned) this.tell(null);
        if (e.shiftKey || e.buttons & 6) this.move(dx, dy);
        else this.rotate(dx * 0.008, dy * 0.008);
      }
    });
    const release = (e) => {
      if (!pointers.delete(e.pointerId)) return;
      if (pointers.size === 0) canvas.classList.remove('turning');
      if (e.type !== 'pointerup' || travelled > 3 || e.button !== 0) return;
      this.pinned = this.read(e.clientX, e.clientY);
      if (!this.pinned) this.tell(null);
      this.placePin();
    };
    canvas.addEventListener('pointerup', release);
    canvas.addEventListener('pointercancel', release);
    canvas.addEventListener('pointerleave', () => { if (!this.pinned) this.tell(null); });
    canvas.addEventListener('contextmenu', (e) => e.preventDefault());
    canvas.addEventListener('dblclick', this.actions.f);
    canvas.addEventListener('wheel', (e) => {
      e.preventDefault();
      this.zoomBy(Math.exp(-e.deltaY * (e.deltaMode ? 0.05 : 0.0015)), e.clientX, e.clientY);
    }, { passive: false });
    addEventListener('keydown', (e) => this.key(e));
  }

  hover(e) {
    if (this.pinned || this.reading || e.pointerType === 'touch') return;
    this.reading = true;
    requestAnimationFrame(() => {
      this.reading = false;
      if (!this.pinned) this.tell(this.read(e.clientX, e.clientY), e.clientX, e.clientY);
    });
  }

  key(e) {
    if (e.ctrlKey || e.metaKey || e.altKey) return;
    const step = Math.PI / 24;
    const view = this.scene.views[Number(e.key) - 1];
    const keys = {
      ...this.actions,
      ArrowLeft: () => this.rotate(-step, 0), ArrowRight: () => this.rotate(step, 0),
      ArrowUp: () => this.rotate(0, -step), ArrowDown: () => this.rotate(0, step),
      '+': () => this.zoomBy(1.25), '=': () => this.zoomBy(1.25), '-': () => this.zoomBy(0.8),
      Escape: () => { this.pinned = null; element('help').hidden = true; this.tell(null); this.placePin(); },
    };
    if (view) this.show(view);
    else if (keys[e.key]) keys[e.key]();
    else return;
    e.preventDefault();
  }
}

(async () => {
  element('message').textContent = '';
  try {
    const scene = JSON.parse(element('scene').textContent);
    if (!('DecompressionStream' in window)) throw new Error('This browser is too old for this picture: it cannot unpack its data.');
    new Page(scene, await arraysOf(scene));
  } catch (error) {
    element('message').textContent = error.message;
  }
})();
