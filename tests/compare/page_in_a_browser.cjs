// The page of glint compare in a real browser: it draws, the wipe moves, the pixels are those of the pictures, nothing is
// fetched and nothing complains. node page_in_a_browser.cjs GLINT SCENE FOLDER; CHROMIUM is the browser.
"use strict";
const assert = require("node:assert");
const { execFileSync, spawnSync } = require("node:child_process");
const fs = require("node:fs");
const path = require("node:path");
const { pathToFileURL } = require("node:url");
const { chromium } = require("playwright-core");

const [glint, scene, folder] = process.argv.slice(2);
// A browser that starts beside a compiler on two cores takes its time.
const PATIENCE_MS = 180000;
const file = (name) => path.join(folder, name);
fs.mkdirSync(folder, { recursive: true });

function compare() {
  for (const model of ["counting", "smooth"])
    execFileSync(glint, ["render", scene, "-o", file(`${model}.exr`), "--size", "160x120", "--spp", "4", "--model", model,
      "--material", "ball=craft-glitter"], { stdio: ["ignore", "ignore", "inherit"] });
  const run = spawnSync(glint, ["compare", file("counting.exr"), file("smooth.exr"), "--json", "-o", file("report.html")],
    { encoding: "utf8", stdio: ["ignore", "pipe", "inherit"], maxBuffer: 1 << 24 });
  assert.strictEqual(run.status, 1, "glitter and its smooth limit do not agree");
  return JSON.parse(run.stdout);
}

// The code of a pixel on the canvas.
const shown = (page, x, y) =>
  page.evaluate(([px, py]) => Array.from(document.getElementById("canvas").getContext("2d").getImageData(px, py, 1, 1).data), [x, y]);

async function settle(page) {
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
}

async function dragWipeTo(page, share) {
  const canvas = await page.locator("#canvas").boundingBox();
  const handle = await page.locator("#handle").boundingBox();
  const y = canvas.y + canvas.height / 2;
  await page.mouse.move(handle.x + handle.width / 2, y);
  await page.mouse.down();
  await page.mouse.move(canvas.x + share * canvas.width, y, { steps: 5 });
  await page.mouse.up();
  await settle(page);
}

// Left of the line is A, right of it B, and both are what the buttons A and B show.
async function wipeShowsBothPictures(page, x, y) {
  const of = {};
  for (const mode of ["a", "b"]) {
    await page.click(`button[data-mode=${mode}]`);
    await settle(page);
    of[mode] = await shown(page, x, y);
  }
  assert.notDeepStrictEqual(of.a, of.b);
  await page.click("button[data-mode=wipe]");
  await dragWipeTo(page, 0.95);
  assert.deepStrictEqual(await shown(page, x, y), of.a);
  await dragWipeTo(page, 0.05);
  assert.deepStrictEqual(await shown(page, x, y), of.b);
  await page.focus("#handle");
  await page.keyboard.press("End");
  await settle(page);
  assert.deepStrictEqual(await shown(page, x, y), of.a);
}

// The numbers under the pointer are the pictures' own, to the precision of a half float and of three printed digits.
async function readoutIsThePixel(page, difference) {
  const [x, y] = difference.at, canvas = await page.locator("#canvas").boundingBox();
  await page.mouse.move(canvas.x + x + 0.5, canvas.y + y + 0.5);
  const text = await page.textContent("#readout");
  const found = /^\((\d+), (\d+)\)  A (\S+) (\S+) (\S+)  B (\S+) (\S+) (\S+)$/.exec(text);
  assert.ok(found, text);
  const v = found.slice(1).map(Number), luminance = (r, g, b) => 0.2126 * r + 0.7152 * g + 0.0722 * b;
  assert.deepStrictEqual(v.slice(0, 2), difference.at);
  const a = luminance(...v.slice(2, 5)), b = luminance(...v.slice(5, 8));
  assert.ok(Math.abs(Math.abs(a - b) - difference.value) <= 0.006 * (a + b), `${text}, expected a difference of ${difference.value}`);
}

async function main() {
  const result = compare();
  const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM || "/usr/bin/chromium", args: ["--no-sandbox", "--disable-gpu"], timeout: PATIENCE_MS
  });
  try {
    const page = await browser.newPage({ viewport: { width: 1280, height: 1000 } });
    page.setDefaultTimeout(PATIENCE_MS);
    const complaints = [], requests = [];
    page.on("console", (message) => message.type() === "error" && complaints.push(message.text()));
    page.on("pageerror", (error) => complaints.push(String(error)));
    page.on("request", (request) => requests.push(request.url()));
    await page.goto(pathToFileURL(file("report.html")).href);
    await page.waitForSelector("body[data-ready=true]");
    await wipeShowsBothPictures(page, ...result.largest_difference.at);
    await readoutIsThePixel(page, result.largest_difference);
    for (const mode of ["difference", "ratio"]) {
      await page.click(`button[data-mode=${mode}]`);
      await settle(page);
      assert.notDeepStrictEqual((await shown(page, ...result.largest_difference.at)).slice(0, 3), [0, 0, 0]);
    }
    for (const id of ["checks", "means", "blocks", "quantiles", "spots"])
      assert.ok(await page.locator(`#${id} tbody tr`).count() > 1, `table ${id} is empty`);
    for (const id of ["blocks-plot", "histogram", "spots-plot", "spectrum"])
      assert.strictEqual(await page.locator(`#${id} svg polyline`).count(), 2, `plot ${id} is empty`);
    await page.screenshot({ path: file("report.png"), fullPage: true });
    assert.deepStrictEqual(complaints, []);
    assert.deepStrictEqual(requests.filter((url) => !url.startsWith("file:") && !url.startsWith("data:") && !url.startsWith("blob:")), []);
  } finally {
    await browser.close();
  }
}

main().catch((error) => {
  console.error(error);
  process.exit(1);
});
