// The report of glint study in a real browser: nothing is wider than the window, on a desk and on a telephone, in light and in
// dark; every figure is drawn; on paper two figures fit on a page and the pages are as many as that makes.
// node page_in_a_browser.cjs GLINT FOLDER; CHROMIUM is the browser.
"use strict";
const assert = require("node:assert");
const { execFileSync } = require("node:child_process");
const fs = require("node:fs");
const path = require("node:path");
const { pathToFileURL } = require("node:url");
const { chromium } = require("playwright-core");

const [glint, folder] = process.argv.slice(2);
// A browser that starts beside a compiler on two cores takes its time.
const PATIENCE_MS = 180000;
const file = (name) => path.join(folder, name);
fs.mkdirSync(folder, { recursive: true });

// A4 between the page's own margins of 16 mm, in pixels of CSS (96 an inch).
const PAPER = { width: Math.round((210 - 32) / 25.4 * 96), height: Math.round((297 - 32) / 25.4 * 96) };

// What reaches beyond the window, and is in nothing that scrolls by itself.
const overflowing = () => {
  const width = document.documentElement.clientWidth, found = [];
  if (document.documentElement.scrollWidth > width) found.push(`the page: ${document.documentElement.scrollWidth} of ${width}`);
  for (const e of document.body.querySelectorAll("*")) {
    const box = e.getBoundingClientRect();
    let scroller = e.parentElement;
    while (scroller && getComputedStyle(scroller).overflowX === "visible") scroller = scroller.parentElement;
    if (!scroller && (box.right > width + 0.5 || box.left < -0.5)) found.push(`${e.tagName} to ${box.right} of ${width}: ${e.textContent.slice(0, 40)}`);
  }
  return found;
};

const figures = () => Array.from(document.images, (i) =>
  ({ name: i.alt, drawn: i.complete && i.naturalWidth > 0, shape: i.clientWidth / i.clientHeight, own: i.naturalWidth / i.naturalHeight }));

// Contrast of letters against the page, as WCAG 2 defines it.
const contrasts = () => {
  const luminance = (color) => {
    const [r, g, b] = color.match(/[\d.]+/g).slice(0, 3).map((c) => (c / 255 <= 0.04045 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const probe = document.createElement("div");
  probe.style.backgroundColor = "Canvas";
  document.body.append(probe);
  const behind = luminance(getComputedStyle(probe).backgroundColor);
  probe.remove();
  const of = {};
  for (const e of document.body.querySelectorAll("p, a, li, td, th, figcaption, h1, h2, caption")) {
    const ink = luminance(getComputedStyle(e).color);
    of[getComputedStyle(e).color] = (Math.max(ink, behind) + 0.05) / (Math.min(ink, behind) + 0.05);
  }
  return of;
};

async function fitsTheWindow(browser, width, colorScheme) {
  const page = await browser.newPage({ viewport: { width, height: 900 }, colorScheme });
  page.setDefaultTimeout(PATIENCE_MS);
  const complaints = [], requests = [];
  page.on("console", (message) => message.type() === "error" && complaints.push(message.text()));
  page.on("request", (request) => requests.push(request.url()));
  await page.goto(pathToFileURL(file("report.html")).href);
  await page.screenshot({ path: file(`report-${width}-${colorScheme}.png`), fullPage: true });
  assert.deepStrictEqual(await page.evaluate(overflowing), [], `${width} pixels`);
  const shown = await page.evaluate(figures);
  assert.ok(shown.length >= 5, `${shown.length} figures`);
  for (const f of shown) {
    assert.ok(f.drawn, `not drawn: ${f.name}`);
    assert.ok(Math.abs(f.shape / f.own - 1) < 0.02, `${f.name}: ${f.shape} instead of ${f.own}`);
  }
  for (const [color, contrast] of Object.entries(await page.evaluate(contrasts)))
    assert.ok(contrast >= 4.5, `${color} in ${colorScheme}: contrast ${contrast.toFixed(2)}, expected 4.5`);
  assert.deepStrictEqual(complaints, []);
  assert.deepStrictEqual(requests.filter((url) => !url.startsWith("file:") && !url.startsWith("data:")), []);
  // Numbers are for people: no exponent of a machine.
  const cells = await page.locator("td, li").allTextContents();
  assert.ok(cells.length > 20, `${cells.length} cells`);
  assert.deepStrictEqual(cells.filter((text) => /\de[-+]\d/.test(text)), []);
  await page.close();
}

async function printsWell(browser) {
  const page = await browser.newPage({ viewport: PAPER });
  page.setDefaultTimeout(PATIENCE_MS);
  await page.goto(pathToFileURL(file("report.html")).href);
  await page.emulateMedia({ media: "print" });
  assert.deepStrictEqual(await page.evaluate(overflowing), [], "paper");
  const heights = await page.evaluate(() => Array.from(document.querySelectorAll("figure"), (f) => {
    const style = getComputedStyle(f);
    return f.getBoundingClientRect().height + parseFloat(style.marginTop) + parseFloat(style.marginBottom);
  }));
  for (const height of heights)
    assert.ok(2 * height <= PAPER.height, `a figure takes ${height} of ${PAPER.height} pixels: two do not fit on a page`);
  const { sections, whole } = await page.evaluate(() => ({ sections: document.querySelectorAll("section").length, whole: document.body.scrollHeight }));
  await page.pdf({ path: file("report.pdf"), format: "A4", preferCSSPageSize: true, printBackground: false });
  const pdf = fs.readFileSync(file("report.pdf"), "latin1");
  const pages = (pdf.match(/\/Type\s*\/Page\b(?!s)/g) || []).length;
  // What is never broken leaves less than half a page free: no more than twice the pages that the whole would fill without a gap.
  const least = Math.ceil(whole / PAPER.height), most = 2 * least;
  assert.ok(pages >= least && pages <= most, `${pages} pages, expected ${least} to ${most} for ${sections} studies`);
  await page.close();
}

async function main() {
  // Four figures and no table of settings; one figure and two tables, and sentences with small numbers.
  execFileSync(glint, ["study", "--lights", "--integrals", "--quick", "-o", folder], { stdio: ["ignore", "ignore", "inherit"] });
  const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM || "/usr/bin/chromium", args: ["--no-sandbox", "--disable-gpu"], timeout: PATIENCE_MS
  });
  try {
    await fitsTheWindow(browser, 1280, "light");
    await fitsTheWindow(browser, 390, "dark");
    await printsWell(browser);
  } finally {
    await browser.close();
  }
}

main().catch((error) => {
  console.error(error);
  process.exit(1);
});
