// SPDX-License-Identifier: Apache-2.0
// A rule base, edited on the page: the branch has the hash that the same file gives on the command
// line, and differs from where the rule first matters.
import assert from "node:assert/strict";
import { copyFileSync, readFileSync } from "node:fs";
import path from "node:path";
import { test } from "node:test";

import { clew, json_lines, open_browser, open_page, scratch_directory, serve } from "./view_server.mjs";

const hash_of = (file) => JSON.parse(clew("info", file, "--json").out).hash;

for (const { graph, world, ticks, place, field, value, line } of [
  { graph: "krishna_kalra", world: "u-trap", ticks: 60, place: "control.rules", field: "target_turn_deg: 9", value: "4", line: "target_turn_deg: 4" },
  { graph: "nakhaeinia", world: "u-trap", ticks: 60, place: "control.rules", field: "- [D, VN, Large", value: "Smooth", line: "  - [D, VN, Smooth, Slow]" },
]) {
  test(`a rule is edited and the run branched with it (${graph})`, async (context) => {
    const directory = scratch_directory(context);
    const file = path.join(directory, "origin.mcap");
    clew("run", graph, "--world", world, "--max-ticks", String(ticks), "--layout", "composed", "--record", file);
    const served = await serve(context, "view", file);
    const { page, complaints } = await open_page(await open_browser(context), served.address);
    await page.fill("#tick", "10");
    await page.keyboard.press("Enter");
    await page.click("#tab-insides");
    const editor = page.locator(`[data-rules="${place}"]`);
    await editor.locator("summary").click();
    // All that the file holds is there, comments and order included.
    const shown = (await editor.locator(".rules > div").evaluateAll((rows) => rows.map((row) =>
      [...row.childNodes].map((node) => node.nodeName === "INPUT" ? node.value : node.textContent).join("")))).join("\n");
    const base = await editor.locator("summary").textContent();
    const text = readFileSync(path.join(process.env.CLEW_SOURCE_DIR, "configs/rulebases", `${base.split(" ").at(-1)}.yaml`), "utf8");
    assert.equal(shown, text);

    const input = editor.getByLabel(field, { exact: true }).first();
    await input.fill(value);
    await page.getByRole("button", { name: "Branch with these rules" }).first().click();
    await page.waitForSelector(".rule-editor [role=status] code", { timeout: 60000 });
    const command = await editor.locator("[role=status] code").textContent();
    const rules = new RegExp(`--set=${place.replace(".", "\\.")}=(\\S+)`).exec(command)[1];
    assert.ok(readFileSync(rules, "utf8").split("\n").includes(line));
    const mine = path.join(directory, "mine.yaml");
    copyFileSync(rules, mine);

    const again = path.join(directory, "again.mcap");
    clew("replay", file, "--branch", "10", "--set", `${place}=${mine}`, "--max-ticks", "2000", "--record", again);
    const hash = await page.evaluate(() => window.clew.session.runs.at(-1).recording.end.hash);
    // The name of the rule base is no part of what the run does.
    assert.equal(hash, hash_of(again));
    assert.notEqual(hash, hash_of(file));

    // What the rule base refuses is told with its place.
    await input.fill("nonsense");
    await page.getByRole("button", { name: "Branch with these rules" }).first().click();
    await page.waitForFunction(() => [...document.querySelectorAll(".rule-editor [role=alert]")].some((told) => /rules-\d+\.yaml:\d+/.test(told.textContent)),
      undefined, { timeout: 8000 }).catch(async () => assert.fail(await page.$$eval(".rule-editor [role=alert]", (all) => all.map((each) => each.textContent).join(" | "))));
    await page.getByRole("button", { name: "As it was" }).first().click();
    assert.equal(await editor.locator("input.changed").count(), 0);
    assert.deepEqual(complaints.filter((each) => !each.includes("400 (Bad Request)")), []);
  });
}

for (const layout of ["processes", "composed"]) {
  test(`a run under way goes on with edited rules, and its recording replays (${layout})`, async (context) => {
    const recording = path.join(scratch_directory(context), "edited.mcap");
    const name = `page-rules-${process.pid}-${layout}`;
    const browser = await open_browser(context);
    const served = await serve(context, "run", "krishna_kalra", "--world", "unsolvable-behind-wall", "--with", "recover.detector=none",
      "--layout", layout, "--pace", "20x", "--name", name, "--record", recording, "--json", "--view");
    const { page, complaints } = await open_page(browser, served.address);
    await page.waitForFunction(() => window.clew.session.last_tick > 20);
    assert.equal(clew("pause", name).status, 0);
    await page.click("#tab-insides");
    const editor = page.locator("[data-rules='control.rules']");
    await editor.locator("summary").click({ timeout: 60000 });
    await editor.getByLabel("target_turn_deg: 9", { exact: true }).first().fill("4");
    await editor.getByRole("button", { name: "Use these rules from now on" }).click();
    await page.waitForSelector(".rule-editor [role=status] code", { timeout: 60000 });
    const tick = Number(/from tick (\d+) on/.exec(await editor.locator("[role=status]").textContent())[1]);
    // The same on the command line names the file, which is there as long as the page is.
    const command = await editor.locator("[role=status] code").textContent();
    const [, file] = /^clew swap \S+ --set=control\.rules=(\S+)$/.exec(command);
    assert.ok(readFileSync(file, "utf8").includes("target_turn_deg: 4"));
    // What the rule base refuses is told with its place, and the run goes on as it was.
    await editor.getByLabel("target_turn_deg: 4", { exact: true }).or(editor.getByLabel("target_turn_deg: 9", { exact: true })).first().fill("nonsense");
    await editor.getByRole("button", { name: "Use these rules from now on" }).click();
    await page.waitForFunction(() => /rules-\d+\.yaml:\d+/.test(document.querySelector("[data-rules='control.rules'] [role=alert]").textContent));
    assert.equal(clew("resume", name).status, 0);
    await page.waitForFunction((from) => window.clew.session.last_tick > from + 20, tick);
    const events = await page.evaluate(() => window.clew.session.runs[0].events.filter(({ kind }) => kind === "change")
      .map(({ tick, stage, text }) => ({ tick, stage, text })));
    assert.deepEqual(events.filter(({ stage }) => stage === "control").map((each) => each.tick), [tick]);
    assert.equal(clew("stop", name).status, 0);
    await served.ended;

    const { interventions } = JSON.parse(clew("info", recording, "--json").out);
    assert.deepEqual(interventions.filter((each) => each.changes?.length > 0).map((each) => each.tick), [tick]);
    const replayed = clew("replay", recording, "--component", "control", "--json");
    assert.equal(replayed.status, 0, replayed.out + replayed.err);
    assert.deepEqual(complaints.filter((text) => !text.includes("ERR_") && !text.includes("409")), []);
  });
}
