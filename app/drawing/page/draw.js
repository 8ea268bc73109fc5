// SPDX-License-Identifier: MIT
// Draws a scene with the renderer's own shaders, in its order and with its tests of depth
// (engine/vulkan/frame_recorder.cpp).

const LIFTS = [0.35, 0.42];

const PICK_VERTEX = `#version 300 es
precision highp float;
layout(location = 0) in vec3 position;
uniform mat4 clip_from_scene;
uniform vec4 tile;
flat out uint face;
out vec2 weights;
void main() {
  vec4 clip = clip_from_scene * vec4(position, 1.0);
  gl_Position = vec4(clip.xy * tile.xy + clip.w * tile.zw, 2.0 * clip.z - clip.w, clip.w);
  gl_Position.y = -gl_Position.y;
  face = uint(gl_VertexID / 3) + 1u;
  weights = vec2(gl_VertexID % 3 == 0, gl_VertexID % 3 == 1);
}`;
const PICK_FRAGMENT = `#version 300 es
precision highp float;
precision highp int;
flat in uint face;
in vec2 weights;
layout(location = 0) out uvec4 hit;
void main() { hit = uvec4(face, floatBitsToUint(weights.x), floatBitsToUint(weights.y), 1u); }`;

class Painter {
  constructor(canvas, scene, arrays) {
    const gl = canvas.getContext('webgl2', { antialias: true, alpha: true, preserveDrawingBuffer: true });
    if (!gl) throw new Error('This picture needs WebGL 2, which this browser or its graphics driver does not offer.');
    Object.assign(this, { gl, scene, arrays, programs: {}, buffers: {} });
    this.corners = arrays.faces.length;
    this.frame = gl.createBuffer();
    const pixel = (internal) => {
      const texture = gl.createTexture();
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.texStorage2D(gl.TEXTURE_2D, 1, internal, 1, 1);
      return texture;
    };
    this.pick = { target: gl.createFramebuffer(), ids: pixel(gl.RGBA32UI), depth: pixel(gl.DEPTH_COMPONENT32F) };
    this.tables = scene.tables.map((text) => this.table(bytesOf(text)));
    this.upload('markers', arrays.markers);
    this.upload('lines', arrays.lines);
    const positions = new Float32Array(3 * this.corners);
    const normals = new Int16Array(4 * this.corners);  // with a label of each corner
    const normal = normalsOf(arrays.normals);
    for (let c = 0; c < this.corners; ++c) {
      const v = arrays.faces[c];
      for (let k = 0; k < 3; ++k) {
        positions[3 * c + k] = arrays.positions[3 * v + k];
        normals[4 * c + k] = Math.round(32767 * normal[3 * v + k]);
      }
      normals[4 * c + 3] = 32767 * ((c + 2) % 3 - 1);
    }
    const openness = new Uint8Array(2 * this.corners);
    for (let c = 0; c < this.corners; ++c) {
      const v = arrays.faces[c];
      openness.set([arrays.openness[2 * v], arrays.openness[2 * v + 1]], 2 * c);
    }
    this.upload('openness', openness);
    this.upload('positions', positions);
    this.upload('normals', normals);
  }

  upload(name, data) {
    const { gl } = this;
    this.buffers[name] ??= gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[name]);
    gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
  }

  table(bytes) {
    const { gl } = this;
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB8, bytes.length / 3, 1, 0, gl.RGB, gl.UNSIGNED_BYTE, bytes);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    return texture;
  }

  // Values, regions and their margins of all corners, as the view paints them.
  values(paint) {
    const { arrays } = this;
    const name = 'values of ' + paint;
    if (this.buffers[name]) return this.buffers[name];
    const all = new Float32Array(3 * this.corners);
    for (let c = 0; c < this.corners; ++c) {
      const v = arrays.origin[arrays.faces[c]];
      const value = paint === 'faces' ? arrays.face_values[c / 3 | 0] : arrays.values[v];
      all[3 * c] = value ?? NO_VALUE;
      if (paint === 'regions') all.set([arrays.regions[v] - 1, arrays.margins[v]], 3 * c + 1);
    }
    this.upload(name, all);
    return this.buffers[name];
  }

  compiled(vertex, fragment, features) {
    const { gl } = this;
    const program = gl.createProgram();
    for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, text.replace('\n', `\n#define FEATURES ${features}u\n`));
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost()) {
        throw new Error('A shader does not compile here: ' + gl.getShaderInfoLog(shader));
      }
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
      throw new Error('Shaders do not fit together here: ' + gl.getProgramInfoLog(program));
    }
    return program;
  }

  use(name, features = 0) {
    const { gl, scene } = this;
    const key = name + features;
    this.programs[key] ??= this.compiled(scene.shaders[name + '.vert'], scene.shaders[name + '.frag'], features);
    const program = this.programs[key];
    gl.useProgram(program);
    const block = gl.getUniformBlockIndex(program, 'FrameBlock');
    if (block !== gl.INVALID_INDEX) gl.uniformBlockBinding(program, block, 0);
    return (uniform) => gl.getUniformLocation(program, uniform);
  }

  // `layout`: of each location the size, and whether it counts instances.
  attributes(buffer, sizes, divisor, first = 0) {
    const { gl } = this;
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    const stride = 4 * sizes.reduce((a, b) => a + b);
    let offset = first * stride;
    for (let i = 0; i < 5; ++i) {
      if (i >= sizes.length) {
        gl.disableVertexAttribArray(i);
        continue;
      }
      gl.enableVertexAttribArray(i);
      gl.vertexAttribPointer(i, sizes[i], gl.FLOAT, false, stride, offset);
      gl.vertexAttribDivisor(i, divisor);
      offset += 4 * sizes[i];
    }
  }

  surfaceAttributes(paint) {
    const { gl, buffers } = this;
    this.attributes(buffers.positions, [3], 0);
    if (!paint) return;
    for (const i of [1, 2, 3]) {
      gl.enableVertexAttribArray(i);
      gl.vertexAttribDivisor(i, 0);
    }
    gl.bindBuffer(gl.ARRAY_BUFFER, buffers.normals);
    gl.vertexAttribPointer(1, 4, gl.SHORT, true, 8, 0);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.values(paint));
    gl.vertexAttribPointer(2, 3, gl.FLOAT, false, 12, 0);
    gl.bindBuffer(gl.ARRAY_BUFFER, buffers.openness);
    gl.vertexAttribPointer(3, 2, gl.UNSIGNED_BYTE, true, 2, 0);
  }

  // What the shaders know of a frame: that of the picture, with this camera and these widths.
  // Places in the block are those that the compiler names.
  uniforms(view, camera, widths) {
    const { gl } = this;
    const numbers = new Float32Array(view.frame);
    if (!this.offsets) {
      this.use('surface');
      const program = gl.getParameter(gl.CURRENT_PROGRAM);
      const names = ['clip_from_scene', 'eye_from_scene', 'extent', 'line', 'wire', 'marker', 'polyline', 'sight'];
      const places = gl.getUniformIndices(program, names.map((name) => 'frame.' + name));
      const offsets = gl.getActiveUniforms(program, places, gl.UNIFORM_OFFSET);
      this.offsets = Object.fromEntries(names.map((name, i) => [name, offsets[i] / 4]));
    }
    const at = this.offsets;
    numbers.set(times(camera.projection, camera.view), at.clip_from_scene);
    numbers.set(camera.view, at.eye_from_scene);
    numbers.set(camera.extent, at.extent);
    const p = camera.projection;
    const tangent = camera.orthographic ? [0, 0] : [1 / p[0], 1 / p[5]];
    numbers.set([...tangent.map((t, k) => 2 * t / camera.extent[k]),
                 -tangent[0] * (1 - p[8]), -tangent[1] * (1 - p[9])], at.sight);
    for (const i of [at.line + 3, at.wire + 3, at.marker + 3, at.polyline, at.polyline + 1]) numbers[i] *= widths;
    gl.bindBufferBase(gl.UNIFORM_BUFFER, 0, this.frame);
    gl.bufferData(gl.UNIFORM_BUFFER, numbers, gl.DYNAMIC_DRAW);
    return { half: numbers[at.polyline], rim: numbers[at.polyline + 1] };
  }

  draw(view, camera, background, widths) {
    const { gl, scene, arrays, buffers } = this;
    const [width, height] = camera.extent;
    const style = this.uniforms(view, camera, widths);
    const b = background;
    gl.viewport(0, 0, width, height);
    gl.clearColor(b[0] * b[3], b[1] * b[3], b[2] * b[3], b[3]);
    gl.clearDepth(0);
    gl.depthMask(true);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.GEQUAL);  // 1 is near
    gl.disable(gl.BLEND);

    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.tables[view.table ?? 0] ?? null);
    this.use('surface', view.features);
    this.surfaceAttributes(view.paint);
    gl.drawArrays(gl.TRIANGLES, 0, this.corners);

    this.drawLines(style, camera, true, widths);
    if (view.arrows) {
      const fields = chosenArrows(scene, arrays, camera, widths * scene.pixel_scale, view.arrows.length);
      fields.forEach((instances, i) => {
        if (instances.length === 0) return;
        this.upload('arrows', new Float32Array(instances));
        const at = this.use('arrow');
        this.attributes(buffers.arrows, [3, 3, 3, 1], 1);
        gl.uniform4f(at('push.colour'), ...view.arrows[i], 1);
        gl.uniform1f(at('push.lift'), LIFTS[i]);
        gl.drawArraysInstanced(gl.TRIANGLES, 0, 9, instances.length / 10);
      });
    }
    this.drawLines(style, camera, false, widths);
    if (!view.markers || arrays.markers.length === 0) return;
    gl.depthMask(false);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    const at = this.use('marker');
    this.attributes(buffers.markers, [3, 3, 4], 1);
    for (const [test, opacity] of [[gl.LESS, view.hidden], [gl.GEQUAL, 1]]) {
      gl.depthFunc(test);
      gl.uniform1f(at('push.opacity'), opacity);
      for (const inside of [0, 1]) {
        gl.uniform1f(at('push.inside'), inside);
        gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, arrays.markers.length / 10);
      }
    }
  }

  // Whole, or in dashes what the surface hides.
  drawLines(style, camera, hidden, widths) {
    const { gl, scene, buffers } = this;
    const dashes = scene.hidden_lines;
    const thinner = hidden ? dashes.width : 1, opacity = hidden ? dashes.opacity : 1;
    const depth = camera.orthographic ? 1 : Math.max(-camera.view[14], 1e-4);
    const dash = hidden ? dashes.dash * scene.pixel_scale * widths * depth / camera.pixels : 0;
    gl.depthMask(false);
    gl.depthFunc(hidden ? gl.LESS : gl.GEQUAL);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    for (const line of scene.lines ?? []) {
      const at = this.use('line');
      this.attributes(buffers.lines, [3, 3, 3, 3, 1], 1, line.first);
      for (const [colour, half] of [[line.rim, style.rim], [line.colour, style.half]]) {
        gl.uniform4f(at('push.colour'), ...colour.map((c) => c * opacity), opacity);
        gl.uniform1f(at('push.half_width'), half * thinner);
        gl.uniform1f(at('push.dash'), dash);
        gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, line.count);
      }
    }
    gl.disable(gl.BLEND);
    gl.depthFunc(gl.GEQUAL);
    gl.depthMask(true);
  }

  // What lies under a pixel: the surface drawn into that pixel alone.
  hit(x, y, camera) {
    const { gl, pick } = this;
    this.picking ??= this.compiled(PICK_VERTEX, PICK_FRAGMENT, 0);
    gl.useProgram(this.picking);
    gl.bindFramebuffer(gl.FRAMEBUFFER, pick.target);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, pick.ids, 0);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, pick.depth, 0);
    gl.viewport(0, 0, 1, 1);
    gl.disable(gl.BLEND);
    gl.enable(gl.DEPTH_TEST);
    gl.depthMask(true);
    gl.depthFunc(gl.GEQUAL);
    gl.clearBufferuiv(gl.COLOR, 0, [0, 0, 0, 0]);
    gl.clearBufferfv(gl.DEPTH, 0, [0]);
    const [width, height] = camera.extent;
    gl.uniformMatrix4fv(gl.getUniformLocation(this.picking, 'clip_from_scene'), false,
                        times(camera.projection, camera.view));
    gl.uniform4f(gl.getUniformLocation(this.picking, 'tile'), width, height,
                 width - 2 * Math.floor(x) - 1, height - 2 * Math.floor(y) - 1);
    this.surfaceAttributes(null);
    gl.drawArrays(gl.TRIANGLES, 0, this.corners);
    const found = new Uint32Array(4);
    gl.readPixels(0, 0, 1, 1, gl.RGBA_INTEGER, gl.UNSIGNED_INT, found);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    if (found[0] === 0) return null;
    const [, a, b] = new Float32Array(found.buffer);
    return { face: found[0] - 1, weights: [a, b, 1 - a - b] };
  }
}

// The arrows that this view has room for (engine/scene/arrows.cpp): ten numbers each, by field.
function chosenArrows(scene, arrays, camera, scale, fieldCount) {
  const { levels, spacing, solid } = scene.arrows;
  const fields = [arrays.heat, arrays.gradients].slice(0, fieldCount);
  const chosen = fields.map(() => []);
  const wanted = spacing * scale;
  const m = camera.view;
  const eyeZ = (p) => m[2] * p[0] + m[6] * p[1] + m[10] * p[2] + m[14];
  const unit = (depth) => camera.pixels / (camera.orthographic ? 1 : Math.max(depth, 1e-4));
  const back = [m[2], m[6], m[10]];
  const eye = [0, 1, 2].map((k) => -(m[4 * k] * m[12] + m[4 * k + 1] * m[13] + m[4 * k + 2] * m[14]));
  const clip = times(camera.projection, m);
  const [width, height] = camera.extent;

  const add = (p, normal, face, size, pixels) => {
    const away = camera.orthographic ? back : minus(eye, p);
    const facing = dot(normal, away) / Math.hypot(...away);
    if ((solid ? facing : Math.abs(facing)) < 0.12) return;
    const [x, y, w] = [0, 1, 3].map((r) => clip[r] * p[0] + clip[4 + r] * p[1] + clip[8 + r] * p[2] + clip[12 + r]);
    const margin = 4 * wanted;
    if (Math.abs(x / w) > 1 + 2 * margin / width || Math.abs(y / w) > 1 + 2 * margin / height) return;
    const room = wanted / pixels;
    const full = Math.min(Math.max(0.55 * size, 0.92 * room), 2 * room);
    let tail = null;
    fields.forEach((field, i) => {
      const vector = at3(field, face).map((v) => v * full);
      if (Math.hypot(...vector) < 1e-3 * full) return;
      tail ??= along(p, -0.5, vector);
      chosen[i].push(...tail, ...vector, ...normal, full);
    });
  };

  const nearest = Math.max(-eyeZ([0, 0, 0]) - 1, 1e-4);
  let next = 0;
  for (const [count, apart] of levels) {
    if (apart * unit(nearest) < wanted) break;
    for (const end = next + count; next < end; ++next) {
      const face = arrays.arrow_faces[next];
      const [a, b, c] = [0, 1, 2].map((k) => at3(arrays.positions, arrays.faces[3 * face + k]));
      const area = cross(minus(b, a), minus(c, a));
      const twice = Math.hypot(...area);
      const normal = area.map((v) => v / twice);
      const size = Math.sqrt(twice / 2);
      const centre = [0, 1, 2].map((k) => (a[k] + b[k] + c[k]) / 3);
      const depth = -eyeZ(centre);
      const pixels = unit(depth);
      if (size * pixels > 3.5 * wanted) {
        const side = Math.max(...[minus(b, a), minus(c, a), minus(c, b)].map((e) => Math.hypot(...e)));
        const n = Math.floor(Math.min(Math.max(side * pixels / (1.3 * wanted), 1), 400));
        for (let i = 0; i < n; ++i) {
          for (let j = 0; i + j < n; ++j) {
            const p = along(along(a, (i + 1 / 3) / n, minus(b, a)), (j + 1 / 3) / n, minus(c, a));
            if (-eyeZ(p) > 1e-4) add(p, normal, face, 0, unit(-eyeZ(p)));
          }
        }
      } else if (depth > 1e-4 && apart * pixels >= wanted) {
        add(centre, normal, face, size, pixels);
      }
    }
  }
  return chosen;
}
