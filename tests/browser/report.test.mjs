// Opens the pages named in REPORTS (a list separated by colons) in a headless browser, as their reader would: on a wide screen
// and on a telephone, on a light and on a dark page. With SCREENSHOTS=FOLDER a picture of each is kept there.
import assert from "node:assert/strict";
import { basename, join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const reports = (process.env.REPORTS ?? "").split(":").filter(Boolean);
const executablePath = process.env.CHROMIUM ?? "/usr/bin/chromium";
const screens = { wide: { width: 1280, height: 900 }, telephone: { width: 390, height: 844 } };

let browser;
before(async () => {
  assert.ok(reports.length > 0, "REPORTS names no page");
  // A sandbox needs rights that containers do not give; nothing may talk to the network.
  const args = ["--no-sandbox", "--disable-gpu", "--disable-background-networking", "--disable-component-update", "--disable-sync"];
  browser = await chromium.launch({ executablePath, args });
});
after(() => browser?.close());

/** The page, opened from disk, and what it asked for and complained of. */
async function open(report, viewport, colorScheme) {
  const page = await browser.newPage({ viewport, colorScheme });
  const complaints = [];
  page.on("pageerror", (error) => complaints.push(String(error)));
  page.on("console", (message) => message.type() === "error" && complaints.push(message.text()));
  const addresses = [];
  page.on("request", (request) => addresses.push(request.url()));
  const address = pathToFileURL(report).href;
  await page.goto(address);
  return { page, complaints, foreign: addresses.filter((a) => a !== address) };
}

/** What of every plot is wrong: nothing in it, no size, marks outside of its frame, coordinates that are no numbers. */
function faultsOfPlots() {
  const faults = [];
  const plots = [...document.querySelectorAll("figure > svg")];
  for (const plot of plots) {
    const name = plot.querySelector("title")?.textContent;
    const frame = plot.getBoundingClientRect();
    if (frame.width < 100 || frame.height < 100) faults.push(`${name}: ${frame.width}×${frame.height}`);
    const marks = [...plot.querySelectorAll("circle.marker, polyline.curve")];
    if (marks.length === 0) faults.push(`${name}: no marks`);
    for (const mark of marks) {
      const box = mark.getBoundingClientRect();
      const inside = box.left >= frame.left - 1 && box.right <= frame.right + 1 && box.top >= frame.top - 1 && box.bottom <= frame.bottom + 1;
      if (!inside) faults.push(`${name}: a mark outside of the plot`);
    }
    if (/NaN|undefined|Infinity/.test(plot.outerHTML)) faults.push(`${name}: not a number`);
  }
  return { count: plots.length, faults };
}

for (const report of reports) {
  for (const [screen, viewport] of Object.entries(screens)) {
    for (const scheme of ["light", "dark"]) {
      test(`${basename(report)} on a ${scheme} ${screen} screen`, async () => {
        const { page, complaints, foreign } = await open(report, viewport, scheme);
        assert.deepEqual(complaints, [], "errors on the page");
        assert.deepEqual(foreign, [], "addresses besides the page's own");
        const { count, faults } = await page.evaluate(faultsOfPlots);
        assert.ok(count > 0, "no plots");
        assert.deepEqual(faults, []);
        // Tables scroll within themselves: the page never does sideways.
        const width = await page.evaluate(() => document.scrollingElement.scrollWidth);
        assert.ok(width <= viewport.width, `the page is ${width} wide on a screen of ${viewport.width}`);
        const rgb = await page.evaluate(() => getComputedStyle(document.body).backgroundColor.match(/\d+/g).map(Number));
        assert.equal(Math.max(...rgb) < 64, scheme === "dark", `background ${rgb}`);
        if (process.env.SCREENSHOTS) {
          const name = `${basename(report, ".html")}-${screen}-${scheme}.png`;
          await page.screenshot({ path: join(process.env.SCREENSHOTS, name) });
        }
        await page.close();
      });
    }
  }
}
