// SPDX-License-Identifier: Apache-2.0
// The panel of insides: what it says of a tick is what `clew explain` says; grids are drawn.
import assert from "node:assert/strict";
import path from "node:path";
import { test } from "node:test";
import { pathToFileURL } from "node:url";

import { clew, json_lines, open_browser, open_page, request, scratch_directory, serve } from "./view_server.mjs";

test("insides of a tick", async (context) => {
  const directory = scratch_directory(context);
  const file = path.join(directory, "left.mcap");
  assert.equal(clew("run", "krishna_kalra", "--layout", "composed", "--record", file).status, 0);
  const tick = json_lines(clew("events", file, "--json").out).find(({ kind }) => kind === "trap").tick;
  const served = await serve(context, "view", file);
  const browser = await open_browser(context);
  const { page, complaints } = await open_page(browser, served.address);
  const shown = (of) => page.waitForFunction((n) => document.querySelector("#insides").dataset.tick === String(n), of, { timeout: 60000 });

  await context.test("are those of clew explain, stage by stage", async () => {
    await page.fill("#tick", String(tick));
    await page.keyboard.press("Enter");
    await page.click("#tab-insides");
    await shown(tick);
    const told = json_lines(clew("explain", file, "--tick", String(tick), "--json").out);
    const texts = await page.$$eval("#insides section", (all) => all.map((each) => [each.dataset.stage, each.querySelector(".told").textContent]));
    assert.deepEqual(texts, told.map(({ stage, text }) => [stage, text]));
  });

  await context.test("lie over the map, each layer with its own entry in the legend", async () => {
    const told = json_lines(clew("explain", file, "--tick", String(tick), "--json").out);
    const layers = told.flatMap(({ stage, picture }) => picture.map(({ name }) => `${stage}: ${name}`));
    assert.ok(layers.length > 2, layers.join(", "));
    await page.waitForSelector("#map-legend label");
    assert.deepEqual(await page.$$eval("#map-legend input", (all) => all.map((each) => each.dataset.insideLayer)), layers);
    // A mark that is told of is drawn where it is: the pixels there change when its layer goes.
    const { stage, layer } = told.flatMap((each) => each.picture.map((one) => ({ stage: each.stage, layer: one }))).find(({ layer: one }) => one.kind === "goal");
    const [x, y] = await page.evaluate(([px, py]) => window.clew.map.pixel(...window.clew.session.runs[0].to_world(window.clew.session.tick, px, py)), layer.places[0]);
    const around = () => page.evaluate(async ([px, py]) => {
      await new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
      const canvas = document.querySelector("#map-canvas");
      return [...canvas.getContext("2d").getImageData(px - 9, py - 9, 18, 18).data].join(" ");
    }, [Math.round(x), Math.round(y)]);
    const with_it = await around();
    const box = page.locator(`[data-inside-layer="${stage}: ${layer.name}"]`);
    await box.focus();
    await page.keyboard.press("Space");
    assert.notEqual(await around(), with_it);
    await page.keyboard.press("Space");
    assert.equal(await around(), with_it);
    if (process.env.CLEW_SCREENSHOT) await page.screenshot({ path: process.env.CLEW_SCREENSHOT });
  });

  await context.test("with values, and a lattice that is drawn", async () => {
    await page.click("[data-inside=classify] > summary");
    await page.click("[data-inside='classify.classifier.som'] > summary");
    const lattice = page.locator("[data-inside='classify.classifier.som'] canvas[role=img][aria-label*='7 rows by 7 columns']");
    await lattice.scrollIntoViewIfNeeded();
    const colours = await lattice.evaluate(async (canvas) => {
      await new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
      const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
      const seen = new Set();
      for (let i = 0; i < data.length; i += 4) seen.add(`${data[i]} ${data[i + 1]} ${data[i + 2]}`);
      return seen.size;
    });
    assert.ok(colours > 5, `${colours} colours`);
  });

  await context.test("follow the tick, and stay open", async () => {
    await page.locator("#map-canvas").focus();
    await page.keyboard.press("ArrowRight");
    await shown(tick + 1);
    assert.equal(await page.evaluate(() => document.querySelector("[data-inside=classify]").open), true);
  });

  await context.test("of a report there are none, and it says why", async () => {
    const report = `${file}.html`;
    assert.equal(clew("report", file, "-o", report).status, 0);
    const { page: alone } = await open_page(browser, pathToFileURL(report));
    await alone.click("#tab-insides");
    assert.match(await alone.textContent("#insides"), /This page has no server/);
  });

  await context.test("bad questions are refused", async () => {
    const own = { Cookie: `clew_view_${served.port}=${served.token}`, Origin: `http://127.0.0.1:${served.port}` };
    for (const question of [{ recording: 1, tick: 5 }, { recording: 0, tick: -1 }, { recording: 0 }, { recording: 0, tick: "5 --plugin=x" }, { recording: 0, tick: 4000000 }]) {
      const answer = await request(served.port, "/explain", own, "POST", JSON.stringify(question));
      assert.equal(answer.status, 400, JSON.stringify(question));
      assert.ok(JSON.parse(answer.body).error.length > 0);
    }
  });

  assert.deepEqual(complaints.filter((text) => !text.includes("400 (Bad Request)")), []);
});
