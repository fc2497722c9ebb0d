#include "io/diagram_page.h"

#include <string_view>

namespace geovor {
namespace {

constexpr std::string_view kPage = R"page(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>@TITLE@</title>
<style>
html, body { margin: 0; height: 100%; overflow: hidden; background: #f4f5f7; color: #1c2733; font: 14px sans-serif; }
canvas { display: block; width: 100%; height: 100%; touch-action: none; outline: none; cursor: grab; }
#label, #help, #title { position: fixed; background: rgba(255, 255, 255, .85); padding: 4px 8px; border-radius: 4px; }
#title { left: 12px; top: 12px; }
#label { left: 12px; top: 46px; white-space: pre; display: none; }
#help { left: 12px; bottom: 12px; font-size: 12px; color: #4a5662; }
</style>
</head>
<body>
<canvas id="view" tabindex="0"></canvas>
<div id="title"></div>
<div id="label"></div>
<div id="help">drag: turn &middot; right button or Shift: move &middot; wheel: zoom &middot; @KEYS@</div>
<script type="application/json" id="data">@DATA@</script>
<script>
'use strict';
const data = JSON.parse(document.getElementById('data').textContent);
const canvas = document.getElementById('view'), label = document.getElementById('label');
const gl = canvas.getContext('webgl', { antialias: true });
if (!gl || !gl.getExtension('OES_element_index_uint')) {
  label.style.display = 'block';
  label.textContent = 'This page needs WebGL, which this browser does not offer.';
  throw new Error('no WebGL');
}
const bytes = name => Uint8Array.from(atob(data[name]), c => c.charCodeAt(0)).buffer;
const floats = name => new Float32Array(bytes(name)), words = name => new Uint32Array(bytes(name));
document.getElementById('title').textContent = data.title;

const palette = [[.55,.71,.87],[.96,.75,.50],[.64,.80,.56],[.90,.61,.62],[.75,.67,.85],[.95,.88,.58],[.55,.80,.79],
  [.90,.70,.82],[.78,.72,.60],[.72,.76,.82],[.80,.85,.50],[.98,.66,.55],[.60,.66,.93],[.86,.80,.72],[.66,.86,.70],[.82,.62,.74]];

function program(vertex, fragment) {
  const made = gl.createProgram();
  for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  return made;
}
function buffer(array, target = gl.ARRAY_BUFFER) {
  const made = gl.createBuffer();
  gl.bindBuffer(target, made);
  gl.bufferData(target, array, gl.STATIC_DRAW);
  return made;
}
function attribute(prog, name, buf, size, type = gl.FLOAT, normalized = false) {
  const at = gl.getAttribLocation(prog, name);
  if (at < 0) return;
  gl.bindBuffer(gl.ARRAY_BUFFER, buf);
  gl.enableVertexAttribArray(at);
  gl.vertexAttribPointer(at, size, type, normalized, 0, 0);
}
const head = 'precision highp float; uniform mat3 turn; uniform vec4 place;' +  // place: shift x, y; scale x, y
  'vec4 seen(vec3 p, float lift) { vec3 q = turn * p; return vec4((q.xy + place.xy) * place.zw, -.9 * q.z - lift, 1.); }';

// Cells: colour and site of a point are bytes, so that the same attributes paint and tell the site under the pointer.
const owners = words('owners'), points = floats('points');
const tints = new Uint8Array(4 * owners.length), names = new Uint8Array(4 * owners.length);
owners.forEach((owner, i) => {
  const site = Math.floor(owner / 16) + 1;
  tints.set(data.tints ? data.tints[site - 1] : palette[owner % 16].map(x => 255 * x), 4 * i);
  names.set([site & 255, site >> 8 & 255, site >> 16 & 255, 255], 4 * i);
});
const triangles = words('triangles');
const cells = { p: buffer(points), n: buffer(floats('normals')), tint: buffer(tints), name: buffer(names),
  index: buffer(triangles, gl.ELEMENT_ARRAY_BUFFER), count: triangles.length };
const cellProgram = program(head +
  'attribute vec3 p, n; attribute vec4 tint, name; varying vec3 normal; varying vec4 paint, who;' +
  'void main() { gl_Position = seen(p, 0.); normal = turn * n; paint = tint; who = name; }',
  'precision highp float; varying vec3 normal; varying vec4 paint, who; uniform vec3 marked; uniform float picking;' +
  'void main() { if (picking > .5) { gl_FragColor = who; return; }' +
  'vec3 n = normalize(normal); if (n.z < 0.) n = -n;' +
  'float light = .42 + .5 * max(dot(n, normalize(vec3(-.4, .5, .77))), 0.) + .16 * max(dot(n, normalize(vec3(.7, -.1, .7))), 0.);' +
  'float mine = step(distance(who.rgb, marked), .002);' +
  'gl_FragColor = vec4(mix(paint.rgb, vec3(1.), .5 * mine) * light, 1.); }');

// Lines: every segment is a strip of a width on the screen.
const lineWords = words('lines'), lineFloats = new Float32Array(lineWords.buffer);
const here = [], other = [], side = [], along = [], lineIndex = [];
const kinds = [[], [], []];
for (let at = 0; at < lineWords.length;) {
  const kind = lineWords[at], n = lineWords[at + 1];
  let s = 0;
  for (let i = 0; i + 1 < n; ++i) {
    const a = lineFloats.subarray(at + 2 + 3 * i, at + 5 + 3 * i), b = lineFloats.subarray(at + 5 + 3 * i, at + 8 + 3 * i);
    const first = side.length, length = Math.hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
    for (const [p, q, w, t] of [[a, b, 1, s], [a, b, -1, s], [b, a, -1, s + length], [b, a, 1, s + length]]) {
      here.push(...p); other.push(...q); side.push(w); along.push(t);
    }
    kinds[kind].push(first, first + 1, first + 2, first + 2, first + 1, first + 3);
    s += length;
  }
  at += 2 + 3 * n;
}
const lines = { p: buffer(new Float32Array(here)), q: buffer(new Float32Array(other)), side: buffer(new Float32Array(side)),
  along: buffer(new Float32Array(along)), sets: kinds.map(k => [buffer(new Uint32Array(k), gl.ELEMENT_ARRAY_BUFFER), k.length]) };
const lineProgram = program(head +
  'attribute vec3 p, q; attribute float side, along; uniform vec2 screen; uniform float width; varying float s;' +
  'void main() { vec4 a = seen(p, .01), b = seen(q, .01); vec2 way = (b.xy - a.xy) * screen; float l = length(way);' +
  'vec2 across = l > 0. ? vec2(-way.y, way.x) / l : vec2(0.); a.xy += side * width * across / screen; gl_Position = a; s = along; }',
  'precision highp float; varying float s; uniform vec3 colour; uniform float dash;' +
  'void main() { if (dash > 0. && fract(s / dash) > .5) discard; gl_FragColor = vec4(colour, 1.); }');

// Sides of triangles: an edge inside a face runs once each way, one at its border is among the lines.
const sides = { count: 0 };
if (data.side) {
  const ends = new Uint32Array(triangles.length + triangles.length % 2);
  for (let t = 0; t < triangles.length; t += 3) {
    for (let k = 0; k < 3; ++k) {
      const a = triangles[t + k], b = triangles[t + (k + 1) % 3];
      if (a < b) { ends[sides.count++] = a; ends[sides.count++] = b; }
    }
  }
  sides.index = buffer(ends.subarray(0, sides.count), gl.ELEMENT_ARRAY_BUFFER);
}
const sideProgram = program(head + 'attribute vec3 p; void main() { gl_Position = seen(p, .0005); }',
  'precision highp float; uniform float strength; void main() { gl_FragColor = vec4(.11, .15, .2, strength); }');

// Sites.
const sites = floats('sites'), siteBuffer = buffer(sites);
const siteProgram = program(head + 'attribute vec3 p; uniform float width;' +
  'void main() { gl_Position = seen(p, .03); gl_PointSize = width; }',
  'precision highp float; void main() { float r = length(gl_PointCoord - .5); if (r > .5) discard;' +
  'gl_FragColor = vec4(mix(vec3(.11, .15, .2), vec3(1.), step(.36, r)), 1.); }');

// The view: a turn (quaternion), a shift and a zoom. It starts from the right, the front and above.
function start() {
  const q = times(axis(1, 0, 0, -Math.acos(1 / Math.sqrt(3))), axis(0, 0, 1, -Math.PI / 4)), m = matrix(q);
  const lo = [1, 1], hi = [-1, -1];
  for (let i = 0; i < points.length; i += 3) {
    for (const k of [0, 1]) {
      const x = m[k] * points[i] + m[k + 3] * points[i + 1] + m[k + 6] * points[i + 2];
      lo[k] = Math.min(lo[k], x);
      hi[k] = Math.max(hi[k], x);
    }
  }
  const w = canvas.clientWidth, h = canvas.clientHeight, room = Math.min(w / (hi[0] - lo[0]), h / (hi[1] - lo[1]));
  const zoom = points.length ? 1.8 * room / Math.min(w, h) : 1;
  return { q, x: points.length ? -(lo[0] + hi[0]) / 2 : 0, y: points.length ? -(lo[1] + hi[1]) / 2 : 0, zoom };
}
function axis(x, y, z, angle) { const s = Math.sin(angle / 2); return [x * s, y * s, z * s, Math.cos(angle / 2)]; }
function times(a, b) {
  return [a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1], a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
    a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3], a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]];
}
function matrix([x, y, z, w]) {  // columns
  return [1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w), 2 * (x * y - z * w), 1 - 2 * (x * x + z * z),
    2 * (y * z + x * w), 2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)];
}
function rotate(dx, dy) {
  const angle = Math.hypot(dx, dy);
  if (angle === 0) return;
  touched = true;
  const q = times(axis(dy / angle, dx / angle, 0, angle), view.q), l = Math.hypot(...q);
  view.q = q.map(x => x / l);
  redraw();
}
let view = start(), shown = { cells: true, edges: true, sites: true, sides: true }, over = -1, marked = -1, pending = false, touched = false;

function place() {  // at zoom 1 the unit ball fills the smaller side
  const s = view.zoom, w = canvas.width, h = canvas.height, m = Math.min(w, h);
  return [view.x, view.y, s * m / w, s * m / h];
}
function uniforms(prog) {
  gl.useProgram(prog);
  gl.uniformMatrix3fv(gl.getUniformLocation(prog, 'turn'), false, matrix(view.q));
  gl.uniform4fv(gl.getUniformLocation(prog, 'place'), place());
  return name => gl.getUniformLocation(prog, name);
}
function paintCells(picking) {
  const u = uniforms(cellProgram), site = (marked >= 0 ? marked : over) + 1;
  gl.uniform1f(u('picking'), picking ? 1 : 0);
  gl.uniform3f(u('marked'), (site & 255) / 255, (site >> 8 & 255) / 255, (site >> 16 & 255) / 255);
  attribute(cellProgram, 'p', cells.p, 3);
  attribute(cellProgram, 'n', cells.n, 3);
  attribute(cellProgram, 'tint', cells.tint, 4, gl.UNSIGNED_BYTE, true);
  attribute(cellProgram, 'name', cells.name, 4, gl.UNSIGNED_BYTE, true);
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, cells.index);
  gl.drawElements(gl.TRIANGLES, cells.count, gl.UNSIGNED_INT, 0);
}
function paintLines() {
  const u = uniforms(lineProgram), unit = window.devicePixelRatio || 1;
  attribute(lineProgram, 'p', lines.p, 3);
  attribute(lineProgram, 'q', lines.q, 3);
  attribute(lineProgram, 'side', lines.side, 1);
  attribute(lineProgram, 'along', lines.along, 1);
  gl.uniform2f(u('screen'), canvas.width, canvas.height);
  const looks = [[[.11, .15, .2], 1.9, 0], [[.72, .1, .12], 1.9, .016 / view.zoom], [[.35, .4, .45], 1.4, 0]];
  looks.forEach(([colour, width, dash], kind) => {
    if (kind < 2 && !shown.edges) return;
    gl.uniform3fv(u('colour'), colour);
    gl.uniform1f(u('width'), width * unit);
    gl.uniform1f(u('dash'), dash);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, lines.sets[kind][0]);
    gl.drawElements(gl.TRIANGLES, lines.sets[kind][1], gl.UNSIGNED_INT, 0);
  });
}
function paintSides() {  // fainter where they would cover the faces
  const u = uniforms(sideProgram), pixels = .5 * data.side * view.zoom * Math.min(canvas.width, canvas.height);
  attribute(sideProgram, 'p', cells.p, 3);
  gl.uniform1f(u('strength'), Math.min(.7, Math.max(.08, pixels / 25)));
  gl.enable(gl.BLEND);
  gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, sides.index);
  gl.drawElements(gl.LINES, sides.count, gl.UNSIGNED_INT, 0);
  gl.disable(gl.BLEND);
}
function paintSites() {
  const u = uniforms(siteProgram), many = Math.sqrt(sites.length / 3);
  gl.uniform1f(u('width'), Math.max(3, Math.min(11, 120 / many)) * Math.min(2, Math.sqrt(view.zoom)) * (window.devicePixelRatio || 1));
  attribute(siteProgram, 'p', siteBuffer, 3);
  gl.drawArrays(gl.POINTS, 0, sites.length / 3);
}
function clear(r, g, b) {
  gl.viewport(0, 0, canvas.width, canvas.height);
  gl.clearColor(r, g, b, 1);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  gl.enable(gl.DEPTH_TEST);
  gl.depthFunc(gl.LEQUAL);
}
function draw() {
  pending = false;
  const unit = window.devicePixelRatio || 1, w = Math.round(canvas.clientWidth * unit), h = Math.round(canvas.clientHeight * unit);
  if (canvas.width !== w || canvas.height !== h) {
    canvas.width = w;
    canvas.height = h;
    if (!touched) view = start();
  }
  clear(.957, .961, .969);
  if (shown.cells) paintCells(false);
  if (shown.sides && sides.count) paintSides();
  paintLines();
  if (shown.sites) paintSites();
}
function redraw() { if (!pending) { pending = true; requestAnimationFrame(draw); } }

/// The site of the cell at a place of the window, -1 for none: the cells are painted with their numbers, off the screen.
let target = null;
function siteAt(x, y) {
  const w = canvas.width, h = canvas.height;
  if (!target || target.w !== w || target.h !== h) {
    target = { w, h, frame: gl.createFramebuffer(), colour: gl.createRenderbuffer(), depth: gl.createRenderbuffer(),
      texture: gl.createTexture() };
    gl.bindTexture(gl.TEXTURE_2D, target.texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, w, h, 0, gl.RGBA, gl.UNSIGNED_BYTE, null);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
    gl.bindRenderbuffer(gl.RENDERBUFFER, target.depth);
    gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT16, w, h);
    gl.bindFramebuffer(gl.FRAMEBUFFER, target.frame);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, target.texture, 0);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, target.depth);
  }
  gl.bindFramebuffer(gl.FRAMEBUFFER, target.frame);
  clear(0, 0, 0);
  paintCells(true);
  const unit = window.devicePixelRatio || 1, pixel = new Uint8Array(4);
  gl.readPixels(Math.round(x * unit), Math.round(h - 1 - y * unit), 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
  gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  return pixel[0] + 256 * pixel[1] + 65536 * pixel[2] - 1;
}
function tell() {
  const site = marked >= 0 ? marked : over;
  label.style.display = site >= 0 ? 'block' : 'none';
  const area = data.areas[site];
  if (site >= 0) label.textContent = (data.names ? data.names[site] : 'site ' + site) + (area === null ? '' : '\narea ' + area.toPrecision(7) + ' ' + data.unit + '\u00b2');
}

const fingers = new Map();
let travelled = 0;
canvas.addEventListener('pointerdown', e => {
  canvas.setPointerCapture(e.pointerId);
  canvas.focus();
  fingers.set(e.pointerId, [e.clientX, e.clientY]);
  if (fingers.size === 1) travelled = 0;
});
canvas.addEventListener('pointermove', e => {
  const before = fingers.get(e.pointerId), span = Math.min(canvas.clientWidth, canvas.clientHeight);
  if (!before) {
    const site = siteAt(e.clientX, e.clientY);
    if (site !== over) { over = site; tell(); redraw(); }
    return;
  }
  const dx = e.clientX - before[0], dy = e.clientY - before[1];
  travelled += Math.abs(dx) + Math.abs(dy);
  if (fingers.size === 1) {
    if (e.shiftKey || e.buttons & 6) move(dx, dy); else rotate(4 * dx / span, 4 * dy / span);
  } else {
    const [a, b] = [...fingers.values()], old = Math.hypot(a[0] - b[0], a[1] - b[1]);
    fingers.set(e.pointerId, [e.clientX, e.clientY]);
    const [c, d] = [...fingers.values()];
    zoomAt(Math.hypot(c[0] - d[0], c[1] - d[1]) / Math.max(old, 1), (c[0] + d[0]) / 2, (c[1] + d[1]) / 2);
    move(dx / 2, dy / 2);
  }
  fingers.set(e.pointerId, [e.clientX, e.clientY]);
});
function lift(e) {
  if (fingers.delete(e.pointerId) && e.type === 'pointerup' && fingers.size === 0 && travelled < 4) {
    const site = siteAt(e.clientX, e.clientY);
    marked = site === marked ? -1 : site;
    tell();
    redraw();
  }
}
canvas.addEventListener('pointerup', lift);
canvas.addEventListener('pointercancel', lift);
canvas.addEventListener('contextmenu', e => e.preventDefault());
canvas.addEventListener('wheel', e => {
  e.preventDefault();
  zoomAt(Math.exp(-e.deltaY * (e.deltaMode ? .05 : .0015)), e.clientX, e.clientY);
}, { passive: false });
function move(dx, dy) {
  touched = true;
  const m = .5 * view.zoom * Math.min(canvas.clientWidth, canvas.clientHeight);
  view.x += dx / m;
  view.y -= dy / m;
  redraw();
}
function zoomAt(factor, x, y) {  // the place under the pointer stays
  touched = true;
  const zoom = Math.min(Math.max(view.zoom * factor, .2), 500), m = .5 * Math.min(canvas.clientWidth, canvas.clientHeight);
  const px = (x - canvas.clientWidth / 2) / m, py = -(y - canvas.clientHeight / 2) / m;
  view.x += px / zoom - px / view.zoom;
  view.y += py / zoom - py / view.zoom;
  view.zoom = zoom;
  redraw();
}
canvas.addEventListener('keydown', e => {
  const step = .12, middle = [canvas.clientWidth / 2, canvas.clientHeight / 2];
  const keys = { ArrowLeft: () => rotate(-step, 0), ArrowRight: () => rotate(step, 0), ArrowUp: () => rotate(0, -step),
    ArrowDown: () => rotate(0, step), '+': () => zoomAt(1.2, ...middle), '=': () => zoomAt(1.2, ...middle),
    '-': () => zoomAt(1 / 1.2, ...middle), r: () => { view = start(); touched = false; }, Home: () => { view = start(); touched = false; },
    e: () => { shown.edges = !shown.edges; }, s: () => { shown.sites = !shown.sites; }, c: () => { shown.cells = !shown.cells; },
    t: () => { shown.sides = !shown.sides; },
    Escape: () => { marked = -1; tell(); } };
  const act = keys[e.key] || keys[e.key.toLowerCase()];
  if (!act || e.ctrlKey || e.metaKey || e.altKey) return;
  e.preventDefault();
  act();
  redraw();
});
window.addEventListener('resize', redraw);
redraw();
</script>
</body>
</html>
)page";

/// Any text inside HTML.
std::string html_escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '<' || c == '>' || c == '&' || code < 0x20) {
      out += "&#" + std::to_string(code) + ";";
    } else {
      out += c;
    }
  }
  return out;
}

}  // namespace

std::string script_escaped(const std::string& text) {
  constexpr char kHex[] = "0123456789abcdef";
  std::string out;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '<' || c == '>' || c == '&' || c == '"' || c == '\\' || code < 0x20) {
      out += std::string("\\u00") + kHex[code >> 4] + kHex[code & 15];
    } else {
      out += c;
    }
  }
  return out;
}

void put_page(const PageParts& parts, ByteStream& out) {
  std::string_view rest = kPage;
  const auto up_to = [&](std::string_view mark) {
    const std::size_t at = rest.find(mark);
    out << rest.substr(0, at);
    rest.remove_prefix(at + mark.size());
  };
  up_to("@TITLE@"), out << html_escaped(parts.title);
  up_to("@KEYS@"), out << parts.keys;
  up_to("@DATA@"), parts.data(out);
  out << rest;
}

}  // namespace geovor
