"use strict";
/* The page of glint compare: decodes the two pictures, draws what is asked for, fills the tables and the plots. */

const result = JSON.parse(document.getElementById("result").textContent);
const WIDTH = result.size[0], HEIGHT = result.size[1], COUNT = WIDTH * HEIGHT;
const element = (id) => document.getElementById(id);
const view = { mode: "wipe", wipe: 0.5, exposure: 0, zoom: 1, a: null, b: null };

/* ---- pixels ---- */

/* All values of half floats, by their bits. */
function halfTable() {
  const table = new Float32Array(65536);
  for (let bits = 0; bits < 65536; bits++) {
    const exponent = (bits >> 10) & 31, fraction = bits & 1023;
    const size = exponent === 0 ? fraction * 2 ** -24
      : exponent === 31 ? (fraction ? NaN : Infinity)
      : (1 + fraction / 1024) * 2 ** (exponent - 15);
    table[bits] = bits & 32768 ? -size : size;
  }
  return table;
}

/* R of every pixel, then G, then B. */
async function decode(id, table) {
  const packed = Uint8Array.from(atob(element(id).textContent), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  const values = new Float32Array(3 * COUNT);
  for (let i = 0; i < 3 * COUNT; i++)
    values[i] = table[bytes[i] | (bytes[3 * COUNT + i] << 8)];
  return values;
}

/* The sRGB code of a linear value, by a table of 4096 steps. */
const srgb = Uint8ClampedArray.from({ length: 4097 }, (_, i) => {
  const x = i / 4096;
  return 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055);
});
const encode = (x) => srgb[x > 0 ? (x < 1 ? (x * 4096) | 0 : 4096) : 0];

/* From blue (B is darker) over grey to red (B is brighter); t in [-1, 1]. */
function diverging(t, out, at) {
  const s = Math.max(-1, Math.min(1, t)), grey = 0.09 * (1 - Math.abs(s));
  out[at] = encode(grey + Math.max(0, s));
  out[at + 1] = encode(grey + 0.25 * Math.abs(s) * Math.abs(s));
  out[at + 2] = encode(grey + Math.max(0, -s));
}

const luminance = (v, i) => 0.2126 * v[i] + 0.7152 * v[COUNT + i] + 0.0722 * v[2 * COUNT + i];

function paintPixel(data, i, x) {
  const gain = 2 ** view.exposure, at = 4 * i;
  data[at + 3] = 255;
  if (view.mode === "difference") {
    diverging((luminance(view.b, i) - luminance(view.a, i)) * gain * view.scale, data, at);
  } else if (view.mode === "ratio") {
    const a = luminance(view.a, i), b = luminance(view.b, i);
    diverging(a === b ? 0 : a > 0 ? (Math.log2(Math.max(b, 1e-30) / a) * gain) / 4 : 1, data, at);
  } else {
    const v = view.mode === "b" || (view.mode === "wipe" && x >= view.wipe * WIDTH) ? view.b : view.a;
    for (let c = 0; c < 3; c++)
      data[at + c] = encode(v[c * COUNT + i] * gain * view.scale);
  }
}

function paint() {
  const canvas = element("canvas"), context = canvas.getContext("2d");
  const picture = context.createImageData(WIDTH, HEIGHT);
  for (let y = 0, i = 0; y < HEIGHT; y++)
    for (let x = 0; x < WIDTH; x++, i++)
      paintPixel(picture.data, i, x);
  context.putImageData(picture, 0, 0);
  const handle = element("handle");
  handle.hidden = view.mode !== "wipe";
  handle.style.left = `${view.wipe * WIDTH * view.zoom}px`;
  handle.setAttribute("aria-valuenow", Math.round(100 * view.wipe));
  canvas.style.width = `${WIDTH * view.zoom}px`;
  canvas.style.height = `${HEIGHT * view.zoom}px`;
  element("exposure-value").textContent = `${view.exposure > 0 ? "+" : ""}${view.exposure} EV`;
  element("legend").textContent = {
    wipe: "A on the left of the line, B on the right. Drag the line, or use the arrow keys.",
    a: "Picture A.",
    b: "Picture B.",
    difference: "Luminance of B less that of A: red where B is brighter, blue where it is darker. Exposure makes small differences visible.",
    ratio: "Luminance of B over that of A: full red at sixteen times, full blue at a sixteenth. Exposure narrows that."
  }[view.mode];
}

let waiting = false;
function repaint() {
  if (!waiting)
    requestAnimationFrame(() => { waiting = false; paint(); });
  waiting = true;
}

/* ---- controls ---- */

function moveWipe(to) {
  view.wipe = Math.max(0, Math.min(1, to));
  repaint();
}

function connectWipe() {
  const handle = element("handle");
  const follow = (event) => {
    const box = element("canvas").getBoundingClientRect();
    moveWipe((event.clientX - box.left) / box.width);
  };
  handle.addEventListener("pointerdown", (event) => {
    handle.setPointerCapture(event.pointerId);
    handle.addEventListener("pointermove", follow);
  });
  for (const end of ["pointerup", "pointercancel"])
    handle.addEventListener(end, () => handle.removeEventListener("pointermove", follow));
  handle.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: -0.01, ArrowRight: 0.01, Home: -1, End: 1 }[event.key];
    if (step === undefined)
      return;
    event.preventDefault();
    moveWipe(view.wipe + step);
  });
}

function connectControls() {
  const buttons = document.querySelectorAll("button[data-mode]");
  for (const button of buttons)
    button.addEventListener("click", () => {
      view.mode = button.dataset.mode;
      for (const other of buttons)
        other.setAttribute("aria-pressed", String(other === button));
      repaint();
    });
  element("exposure").addEventListener("input", (event) => {
    view.exposure = Number(event.target.value);
    repaint();
  });
  element("zoom").addEventListener("change", (event) => {
    view.zoom = Number(event.target.value);
    repaint();
  });
  element("canvas").addEventListener("pointermove", (event) => {
    const box = event.target.getBoundingClientRect();
    const x = Math.floor((event.clientX - box.left) / view.zoom), y = Math.floor((event.clientY - box.top) / view.zoom);
    if (x < 0 || y < 0 || x >= WIDTH || y >= HEIGHT)
      return;
    const i = y * WIDTH + x, rgb = (v) => [0, 1, 2].map((c) => number(v[c * COUNT + i], 3)).join(" ");
    element("readout").textContent = `(${x}, ${y})  A ${rgb(view.a)}  B ${rgb(view.b)}`;
  });
}

/* ---- tables ---- */

function number(x, digits = 4) {
  if (x === null || Number.isNaN(x))
    return "–";
  return x !== 0 && (Math.abs(x) < 1e-3 || Math.abs(x) >= 1e6) ? x.toExponential(digits - 1) : Number(x.toPrecision(digits)).toString();
}

const spread = (r) => `${number(r.ratio)} ± ${number(r.standard_error, 2)}`;

/* Cells are texts, or pairs of a text and a class. */
function table(id, head, rows) {
  const place = element(id);
  const add = (parent, tag, cells) => {
    const line = parent.appendChild(document.createElement("tr"));
    for (const cell of cells) {
      const [text, kind] = Array.isArray(cell) ? cell : [cell, ""];
      const made = line.appendChild(document.createElement(tag));
      made.textContent = text;
      made.className = kind;
    }
  };
  add(place.createTHead(), "th", head);
  const body = place.createTBody();
  for (const row of rows)
    add(body, "td", row);
}

const A = ["A", "a"], B = ["B", "b"];
const WORDS = { pass: "within the tolerance", unclear: "outside, but by less than the noise", fail: "outside the tolerance" };

function fillTables() {
  element("name-a").textContent = result.a;
  element("name-a").className = "a";
  element("name-b").textContent = result.b;
  element("name-b").className = "b";
  const verdict = element("verdict");
  verdict.className = result.verdict;
  verdict.textContent = {
    pass: "B agrees with A within every tolerance.",
    unclear: "No check fails, but the noise is too large to tell for some.",
    fail: "B does not agree with A."
  }[result.verdict] + (result.same_facets ? " Both show the same facets, so they are held against each other pixel by pixel." : "");
  table("checks", ["check", "found", "expected", "standard error", ""], result.checks.map((c) =>
    [c.name, number(c.value), `${number(c.expected)} ± ${number(c.tolerance)}`, number(c.standard_error, 2), [WORDS[c.outcome], c.outcome]]));
  element("how").textContent = `${result.pixels} of ${COUNT} pixels are compared. Standard errors are the jackknife over 8 × 8 parts of the picture. The background is ` +
    (result.background === "smooth" ? "the smooth picture in the file." : "the mean around, as neither file has a smooth picture.") +
    ` Root mean square difference ${number(result.rms_difference)} of A's mean; correlation ${number(result.correlation)}; the largest difference is ${number(result.largest_difference.value)} at (${result.largest_difference.at.join(", ")}).`;
  table("means", ["", A, B, "B / A"], Object.entries(result.mean).map(([name, r]) => [name, number(r.a), number(r.b), spread(r)]));
  table("blocks", ["block", A, B, "B / A", "correlation"], result.blocks.map((b) =>
    [`${b.side} × ${b.side}`, number(b.variance.a), number(b.variance.b), spread(b.variance), number(b.correlation, 3)]));
  table("quantiles", ["share below", A, B, "B / A"], result.quantiles.map((q) =>
    [q.share === 1 ? "the brightest" : `${number(100 * q.share)} %`, number(q.a), number(q.b), number(q.a === q.b ? 1 : q.b / q.a)]));
  table("spots", ["brighter than", A, B, ["A, area", "a"], ["B, area", "b"]], result.sparks.map((s) =>
    [`${s.threshold} ×`, `${number(s.a_per_megapixel, 3)} / Mpx`, `${number(s.b_per_megapixel, 3)} / Mpx`, `${number(100 * s.a_area, 3)} %`, `${number(100 * s.b_area, 3)} %`]));
}

/* ---- plots ---- */

const SVG = "http://www.w3.org/2000/svg";
function svg(parent, tag, attributes, text) {
  const made = parent.appendChild(document.createElementNS(SVG, tag));
  for (const [key, value] of Object.entries(attributes))
    made.setAttribute(key, value);
  if (text !== undefined)
    made.textContent = text;
  return made;
}

/* Whole powers of ten, or of two where there are few of those. */
function logTicks(low, high) {
  const base = high / low > 300 ? 10 : 2, ticks = [];
  for (let e = Math.ceil(Math.log(low) / Math.log(base) - 1e-9); base ** e <= high * (1 + 1e-9); e++)
    ticks.push(base ** e);
  const every = Math.ceil(ticks.length / 8);
  return ticks.filter((_, i) => i % every === 0);
}

/* Two lines over x, both axes logarithmic; what is not positive is left out. */
function plot(id, title, xs, a, b, xName, yName) {
  const place = element(id), W = 520, H = 300, left = 70, right = 12, top = 14, bottom = 42;
  const xRange = [Math.min(...xs), Math.max(...xs)], values = a.concat(b).filter((v) => v > 0);
  if (values.length === 0 || !(xRange[1] > xRange[0])) {
    place.textContent = "Nothing to plot.";
    return;
  }
  const low = Math.min(...values) / 1.3, high = Math.max(...values) * 1.3;
  const X = (x) => left + ((W - left - right) * Math.log(x / xRange[0])) / Math.log(xRange[1] / xRange[0]);
  const Y = (y) => H - bottom - ((H - top - bottom) * Math.log(y / low)) / Math.log(high / low);
  const s = svg(place, "svg", { viewBox: `0 0 ${W} ${H}`, width: W, height: H, role: "img", "aria-label": title });
  for (const t of logTicks(low, high)) {
    svg(s, "line", { class: "grid", x1: left, x2: W - right, y1: Y(t), y2: Y(t) });
    svg(s, "text", { x: left - 6, y: Y(t) + 4, "text-anchor": "end" }, number(t, 3));
  }
  for (const t of logTicks(...xRange)) {
    svg(s, "line", { class: "grid", x1: X(t), x2: X(t), y1: top, y2: H - bottom });
    svg(s, "text", { x: X(t), y: H - bottom + 16, "text-anchor": "middle" }, number(t, 3));
  }
  for (const [ys, kind] of [[a, "a"], [b, "b"]]) {
    const points = xs.map((x, i) => [x, ys[i]]).filter(([, y]) => y > 0).map(([x, y]) => `${X(x).toFixed(1)},${Y(y).toFixed(1)}`);
    svg(s, "polyline", { class: `line ${kind}`, points: points.join(" ") });
  }
  svg(s, "text", { x: (left + W - right) / 2, y: H - 8, "text-anchor": "middle" }, xName);
  svg(s, "text", { x: 14, y: (top + H - bottom) / 2, "text-anchor": "middle", transform: `rotate(-90 14 ${(top + H - bottom) / 2})` }, yName);
  svg(s, "text", { class: "a", x: W - right - 60, y: top + 14 }, "A");
  svg(s, "text", { class: "b", x: W - right - 30, y: top + 14 }, "B");
}

function drawPlots() {
  const by = (list, key) => list.map((x) => x[key]);
  plot("blocks-plot", "Variance of block means by the side of the block", by(result.blocks, "side"),
    result.blocks.map((b) => b.variance.a), result.blocks.map((b) => b.variance.b), "side of a block, pixels", "variance");
  plot("histogram", "Histogram of luminance", by(result.histogram, "from"), by(result.histogram, "a"), by(result.histogram, "b"),
    "luminance over A's mean", "pixels");
  plot("spots-plot", "Sparks by how bright they are", by(result.sparks, "threshold"), by(result.sparks, "a_per_megapixel"),
    by(result.sparks, "b_per_megapixel"), "times the background", "sparks per megapixel");
  plot("spectrum", "Power spectra", by(result.spectrum, "frequency"), by(result.spectrum, "a"), by(result.spectrum, "b"),
    "cycles per pixel", "power");
}

/* ---- start ---- */

async function start() {
  fillTables();
  drawPlots();
  const halves = halfTable();
  [view.a, view.b] = await Promise.all([decode("pixels-a", halves), decode("pixels-b", halves)]);
  element("canvas").width = WIDTH;
  element("canvas").height = HEIGHT;
  /* The brighter of the means is shown as middle grey. */
  const mean = Math.max(result.mean.luminance.a, result.mean.luminance.b);
  view.scale = mean > 0 ? 0.18 / mean : 1;
  connectWipe();
  connectControls();
  paint();
  document.body.dataset.ready = "true";
}
start();
