// SPDX-License-Identifier: Apache-2.0
// The page with the keyboard alone: everything that can be done has a key, or is reached by Tab.
import assert from "node:assert/strict";
import path from "node:path";
import { test } from "node:test";

import { clew, open_browser, open_page, scratch_directory, serve } from "./view_server.mjs";

const kMostTabs = 400;

/// Presses Tab until what the selector names has the focus; backwards with "Shift+Tab".
async function tab_to(page, selector, key = "Tab") {
  for (let i = 0; i < kMostTabs; i++) {
    if (await page.evaluate((wanted) => document.activeElement?.matches(wanted), selector)) return;
    await page.keyboard.press(key);
  }
  assert.fail(`Tab does not reach ${selector}`);
}

/// Types to choose an entry of the list that has the focus.
async function choose(page, selector, value) {
  await tab_to(page, selector);
  for (let i = 0; i < 200; i++) {
    if (await page.evaluate((wanted) => document.activeElement.value === wanted, value)) return;
    await page.keyboard.press("ArrowUp");
    if (i === 100) await page.keyboard.press("End");
  }
  assert.fail(`${selector} has no ${value}`);
}

test("a recording, with the keyboard alone", async (context) => {
  const file = path.join(scratch_directory(context), "left.mcap");
  assert.equal(clew("run", "krishna_kalra", "--layout", "composed", "--record", file).status, 0);
  const served = await serve(context, "view", file);
  const { page, complaints } = await open_page(await open_browser(context), served.address);
  const tick = () => page.evaluate(() => window.clew.session.tick);

  await context.test("Tab reaches all that can be used, and shows where it is", async () => {
    for (const key of ["o", "i", "x", "e"]) {
      // In a field keys are letters.
      await page.evaluate(() => document.activeElement.blur());
      await page.keyboard.press(key);
      if (key === "x") await page.waitForFunction(() => document.querySelector("#insides").dataset.tick, undefined, { timeout: 60000 });
      const missed = await page.evaluate(() => {
        const usable = [...document.querySelectorAll("button, input, select, summary, a[href], canvas[tabindex]")]
          .filter((each) => !each.disabled && each.checkVisibility());
        for (const each of usable) each.dataset.missed = "";
        return usable.length;
      });
      assert.ok(missed > 15, String(missed));
      const start = await page.evaluate(() => document.activeElement.outerHTML);
      for (let i = 0; i < kMostTabs; i++) {
        await page.keyboard.press("Tab");
        const seen = await page.evaluate(() => {
          const { activeElement: at } = document;
          if (at === document.body || !("missed" in at.dataset)) return at === document.body;
          delete at.dataset.missed;
          const { outlineStyle, outlineWidth } = getComputedStyle(at);
          at.dataset.outline = `${outlineStyle} ${outlineWidth}`;
          return false;
        });
        if (seen && i > 3) break;
      }
      const left = await page.$$eval("[data-missed]", (all) => all.map((each) => each.outerHTML.slice(0, 120)));
      assert.deepEqual(left, [], `${key} from ${start.slice(0, 80)}`);
      const bare = await page.$$eval("[data-outline]", (all) => all.filter((each) => /^none|\b0px/.test(each.dataset.outline)).map((each) => each.outerHTML.slice(0, 120)));
      assert.deepEqual(bare, []);
    }
  });

  await context.test("time goes by keys", async () => {
    await page.evaluate(() => document.activeElement.blur());
    await page.keyboard.press("Home");
    assert.equal(await tick(), 0);
    await page.keyboard.press("ArrowRight");
    await page.keyboard.press("Shift+ArrowRight");
    assert.equal(await tick(), 11);
    await page.keyboard.press("n");
    assert.ok(await tick() > 11);
  });

  await context.test("a distance is measured with arrows and Enter", async () => {
    await page.keyboard.press("m");
    await page.keyboard.press("Enter");
    for (let i = 0; i < 4; i++) await page.keyboard.press("ArrowRight");
    await page.keyboard.press("Enter");
    const [length, scale] = await page.evaluate(() => {
      const [[x1], [x2]] = [window.clew.map.place(0, 0), window.clew.map.place(32, 0)];
      return [window.clew.map.measured, x2 - x1];
    });
    assert.ok(Math.abs(length - scale) < 1e-9, `${length} ${scale}`);
    await page.keyboard.press("m");
  });

  await context.test("a layer goes and comes", async () => {
    await page.keyboard.press("l");
    const name = await page.evaluate(() => document.activeElement.dataset.layer);
    assert.ok(name);
    const checked = () => page.evaluate(() => document.activeElement.checked);
    const before = await checked();
    await page.keyboard.press("Space");
    assert.equal(await checked(), !before);
    await page.keyboard.press("Space");
    await page.keyboard.press("l");
  });

  await context.test("a field is plotted", async () => {
    await page.keyboard.press("i");
    await tab_to(page, "details[data-topic] td button");
    await page.keyboard.press("Enter");
    await page.waitForSelector("#plots figure");
  });

  await context.test("another behaviour is branched to", async () => {
    await page.evaluate(() => document.activeElement.blur());
    await page.keyboard.press("e");
    await choose(page, "[data-field=part]", "detector");
    await choose(page, "[data-field=behaviour]", "none");
    await tab_to(page, "#branch");
    await page.keyboard.press("Enter");
    await page.waitForSelector("#branches li", { timeout: 60000 });
    assert.match(await page.textContent("#branches code"), /--with=recover\.detector=none/);
  });

  await context.test("a world is drawn, and run", async () => {
    await choose(page, "#run-world", "");
    await page.waitForSelector("#drawing button");
    await tab_to(page, "#drawing [data-part=wall]");
    await page.keyboard.press("Enter");
    await page.keyboard.press("ArrowUp");
    await page.keyboard.press("Enter");
    for (let i = 0; i < 6; i++) await page.keyboard.press("Shift+ArrowRight");
    await page.keyboard.press("Enter");
    await tab_to(page, "[aria-label='Most ticks']");
    await page.keyboard.press("Control+a");
    await page.keyboard.type("100");
    await tab_to(page, "#run");
    await page.keyboard.press("Enter");
    await page.waitForFunction(() => document.querySelectorAll("#branches li").length === 2, undefined, { timeout: 60000 });
    const walls = await page.evaluate(() => window.clew.session.run.world.walls);
    assert.equal(walls.length, 1);
    assert.ok(walls[0][2] > walls[0][0] && walls[0][1] === walls[0][3], JSON.stringify(walls));
  });

  await context.test("the keys are told, and leave by Escape", async () => {
    await page.evaluate(() => document.activeElement.blur());
    await page.keyboard.press("?");
    assert.ok(await page.locator("dialog#keys[open] kbd").count() > 20);
    await page.keyboard.press("Escape");
    assert.equal(await page.locator("dialog#keys[open]").count(), 0);
  });

  assert.deepEqual(complaints, []);
});

test("a run under way, with the keyboard alone", async (context) => {
  const name = `page-keys-${process.pid}`;
  const served = await serve(context, "run", "default", "--world", "unsolvable-behind-wall", "--set", "recover.escape.remembered_map.proof_s=10000",
    "--layout", "composed", "--pace", "20x", "--name", name, "--view");
  const { page, complaints } = await open_page(await open_browser(context), served.address);
  await page.keyboard.press("c");
  await page.waitForFunction(() => window.clew.session.last_tick > 5);
  await page.keyboard.press("k");
  await page.waitForFunction(() => document.querySelector("#orders").textContent.includes("pause at tick"));
  await page.keyboard.press("j");
  await page.waitForFunction(() => document.querySelector("#orders").textContent.includes("step at tick"));
  await page.keyboard.press("k");
  await page.waitForFunction(() => document.querySelector("#orders").textContent.includes("resume at tick"));
  // The new target is near: the run is held, so that it is not over before it is stopped.
  await page.keyboard.press("k");
  await page.waitForFunction(() => document.querySelector("#orders").textContent.split("pause at tick").length === 3);
  await page.keyboard.press("g");
  for (let i = 0; i < 3; i++) await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => document.querySelector("#orders").textContent.includes("goal at tick"));
  await tab_to(page, "#live-stop");
  await page.keyboard.press("Enter");
  await page.waitForSelector("body[data-ended]");
  await served.ended;
  assert.deepEqual(complaints.filter((text) => !text.includes("ERR_")), []);
});
