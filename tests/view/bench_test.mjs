// SPDX-License-Identifier: Apache-2.0
// The page of a bench, opened as a file: sorted, followed from a cell to its runs, and from a run to
// its report; what it says is what results.jsonl says.
import assert from "node:assert/strict";
import { existsSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import path from "node:path";
import { test } from "node:test";
import { pathToFileURL } from "node:url";

import { clew, json_lines, open_browser, open_page, scratch_directory } from "./view_server.mjs";

const kSuite = `format: clew-suite/1
about: "For the test of <b>the page</b>."
graphs: [reactive, krishna_kalra]
worlds:
  static: [u-trap, open-field, unsolvable-box]
seeds: [1, 2]
max_ticks: 600
`;

test("the page of a bench", async (context) => {
  const directory = scratch_directory(context);
  const out = path.join(directory, "out");
  const suite = path.join(directory, "suite.yaml");
  writeFileSync(suite, kSuite);
  const made = clew("bench", suite, "--out", out, "--keep", "2", "--json");
  assert.equal(made.status, 0, made.err);
  const results = json_lines(made.out);
  const failed = results.filter(({ success }) => success === false);
  assert.ok(failed.length > 2, JSON.stringify(results.map(({ outcome }) => outcome)));

  await context.test("of runs that failed as many are kept as were asked for, and are the same runs", () => {
    const kept = readdirSync(path.join(out, "runs"));
    assert.equal(kept.filter((name) => name.endsWith(".mcap")).length, 2);
    for (const name of kept.filter((each) => each.endsWith(".mcap"))) {
      const info = JSON.parse(clew("info", path.join(out, "runs", name), "--json").out);
      assert.ok(failed.some(({ hash }) => hash === info.hash), name);
    }
  });

  const browser = await open_browser(context);
  const { page, complaints } = await open_page(browser, pathToFileURL(path.join(out, "report.html")));
  await page.route(/^https?:/, (route) => assert.fail(`it asks for ${route.request().url()}`));
  const rows = () => page.$$eval("#runs tbody tr", (all) => all.map((row) => [...row.children].map((cell) => cell.textContent)));
  const columns = () => page.$$eval("#runs thead th", (all) => all.map((cell) => cell.textContent));

  await context.test("shows every run, and texts as texts", async () => {
    const shown = await rows();
    const at = Object.fromEntries((await columns()).map((name, i) => [name, i]));
    assert.equal(shown.length, results.length);
    for (const row of shown) {
      const run = results[Number(row[at.run]) - 1];
      assert.deepEqual([row[at.graph], row[at.world], row[at.seed], row[at.outcome], row[at.ticks]],
        [run.graph, run.world, String(run.seed), run.outcome, String(run.ticks)]);
    }
    assert.match(await page.textContent("main"), /For the test of <b>the page<\/b>\./);
    if (process.env.CLEW_SCREENSHOT) await page.screenshot({ path: process.env.CLEW_SCREENSHOT, fullPage: true });
  });

  await context.test("charts have a point and an interval for each graph, and lead to its runs", async () => {
    const said = await page.$$eval(".chart:first-child .point", (all) => all.map((point) => point.getAttribute("aria-label")));
    assert.equal(said.length, 2);
    for (const label of said) assert.match(label, /: [\d.]+ \[[\d.]+, [\d.]+\]/);
    await page.locator(".chart:first-child .point").first().focus();
    await page.keyboard.press("Enter");
    const shown = await rows();
    assert.equal(shown.length, results.length / 2);
    assert.ok(shown.every((row) => row[1] === "reactive"));
    await page.getByRole("button", { name: "All runs" }).click();
    assert.equal((await rows()).length, results.length);
  });

  await context.test("a column sorts by its numbers, both ways", async () => {
    const ticks = (await columns()).indexOf("ticks");
    const head = page.locator("#runs thead button", { hasText: /^ticks$/ });
    for (const sign of [1, -1]) {
      await head.click();
      const shown = (await rows()).map((row) => Number(row[ticks]));
      assert.deepEqual(shown, [...shown].sort((a, b) => sign * (a - b)));
    }
    const table = page.locator("[data-table='All worlds']");
    await table.locator("thead button", { hasText: /^success$/ }).focus();
    await page.keyboard.press("Space");
    const order = await table.locator("tbody th").allTextContents();
    await page.keyboard.press("Space");
    assert.deepEqual(await table.locator("tbody th").allTextContents(), order.reverse());
  });

  await context.test("a cell leads to its runs, and a run to its report", async () => {
    const cell = page.locator("[data-table='All worlds'] tbody tr", { hasText: "reactive" }).locator("td").nth(1).locator("button");
    await cell.click();
    const shown = await rows();
    const wanted = results.filter(({ graph, solvable }) => graph === "reactive" && solvable === true);
    assert.equal(shown.length, wanted.length);
    await page.getByRole("button", { name: "All runs" }).click();
    const link = page.locator("#runs a").first();
    const number = Number(await link.textContent());
    await link.click();
    await page.waitForSelector("body[data-ready] #map-canvas");
    assert.equal(await page.evaluate(() => window.clew.session.last_tick), results[number - 1].ticks);
    if (process.env.CLEW_SCREENSHOT) await page.screenshot({ path: `${process.env.CLEW_SCREENSHOT}.run.png` });
  });

  await context.test("nothing is kept where nothing is wanted", () => {
    assert.equal(clew("bench", suite, "--out", out, "--keep", "0").status, 0);
    assert.ok(!existsSync(path.join(out, "runs")));
    assert.match(readFileSync(path.join(out, "report.html"), "utf8"), /Content-Security-Policy/);
  });

  assert.deepEqual(complaints, []);
});
