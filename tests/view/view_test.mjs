// SPDX-License-Identifier: Apache-2.0
// `clew view` in a real browser: what the page says is what the recording, `clew events` and
// `clew diff` say; and nobody but the page gets anything.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import path from "node:path";
import { test } from "node:test";

import { clew, json_lines, open_browser, open_page, request, scratch_directory, serve } from "./view_server.mjs";

/// A run that leaves a trap, and what would have become of it without its detector.
function record(directory) {
  const left = path.join(directory, "left.mcap");
  const stuck = path.join(directory, "stuck.mcap");
  assert.equal(clew("run", "krishna_kalra", "--layout", "composed", "--record", left).status, 0);
  const branched = clew("replay", left, "--with", "recover.detector=none", "--branch", "100", "--max-ticks", "200", "--record", stuck);
  assert.equal(branched.status, 3, branched.err);
  return [left, stuck];
}

test("the page tells what the recordings tell", async (context) => {
  const [left, stuck] = record(scratch_directory(context));
  const served = await serve(context, "view", left, stuck);
  const { page, complaints } = await open_page(await open_browser(context), served.address);

  await context.test("the token is gone from the address, and no script can read the cookie", async () => {
    assert.equal(page.url(), `http://127.0.0.1:${served.port}/`);
    const cookies = await page.context().cookies();
    assert.deepEqual(cookies.map(({ value, httpOnly, sameSite }) => ({ value, httpOnly, sameSite })),
      [{ value: served.token, httpOnly: true, sameSite: "Strict" }]);
    await page.reload();
    await page.waitForSelector("body[data-ready]");
  });

  await context.test("the robot of every tick", async () => {
    for (const [index, file] of [left, stuck].entries()) {
      const told = json_lines(clew("echo", file, "state", "--jsonl", "--field", "pose_world_robot").out)
        .map(({ tick, pose_world_robot: pose }) => [tick, pose.x_m, pose.y_m, pose.heading_rad]);
      const shown = await page.evaluate((run) => {
        const { ticks, truth } = window.clew.session.runs[run];
        return ticks.map((tick, i) => [tick, truth[i].x, truth[i].y, truth[i].heading]);
      }, index);
      assert.deepEqual(shown, told);
    }
  });

  await context.test("the events", async () => {
    const told = json_lines(clew("events", left, "--json").out)
      .map(({ tick, kind, rule, shadow, earlier }) => ({ tick, kind, rule, shadow, earlier: earlier?.tick ?? null }));
    const shown = await page.evaluate(() => window.clew.session.runs[0].events.filter((event) => event.rule !== "")
      .map(({ tick, kind, rule, shadow, earlier }) => ({ tick, kind, rule, shadow, earlier: earlier?.tick ?? null })));
    assert.ok(told.some(({ kind }) => kind === "trap"));
    assert.deepEqual(shown, told);
  });

  await context.test("the first field that differs", async () => {
    const told = JSON.parse(clew("diff", left, stuck, "--json").out).first_difference;
    await page.keyboard.press("d");
    const shown = await page.evaluate(() => {
      const { topic, tick, field, a, b } = window.clew.compare();
      const value = (leaf) => (leaf === undefined ? null : leaf.word ?? leaf.value);
      return { topic, tick, field, a: value(a), b: value(b) };
    });
    assert.deepEqual(shown, told);
    assert.equal(await page.inputValue("#tick"), String(told.tick));
    assert.match(await page.textContent("#notice"), new RegExp(`^tick ${told.tick}, ${told.topic}\\.`));
  });

  await context.test("a field is plotted by a click, with the recording's values", async () => {
    await page.click("#tab-messages");
    await page.fill("#field-filter", "state.path_length_m");
    await page.click("button[aria-label='Plot state.path_length_m']");
    await page.waitForSelector("figure[data-plot='state.path_length_m'] canvas");
    const told = json_lines(clew("echo", left, "state", "--jsonl", "--field", "path_length_m").out)
      .map(({ tick, path_length_m: value }) => [tick, value]);
    assert.deepEqual(await page.evaluate(() => window.clew.plots.values("state", "path_length_m", 0)), told);
  });

  await context.test("the inspector shows every field of a message, of both runs", async () => {
    await page.fill("#tick", "50");
    await page.keyboard.press("Enter");
    await page.fill("#field-filter", "scan.");
    const told = json_lines(clew("echo", left, "scan", "--jsonl", "--from", "50", "--to", "50").out)[0];
    await page.waitForSelector("td[data-path='ranges_m[6]']");
    const shown = await page.evaluate(() => [...document.querySelectorAll("details[data-topic=scan] tr")]
      .filter((row) => row.querySelector("td")).map((row) => [row.children[0].dataset.path, row.children[1].title]));
    told.ranges_m.forEach((value, i) => assert.ok(
      shown.some(([field, text]) => field === `ranges_m[${i}]` && Number(text) === value), `ranges_m[${i}]`));
    await page.fill("#field-filter", "");
  });

  await context.test("keys step, jump to events and play", async () => {
    await page.click("#map-canvas", { position: { x: 400, y: 60 } });
    await page.keyboard.press("Home");
    assert.equal(await page.evaluate(() => window.clew.session.tick), 0);
    await page.keyboard.press("ArrowRight");
    await page.keyboard.press("Shift+ArrowRight");
    assert.equal(await page.evaluate(() => window.clew.session.tick), 11);
    const first = json_lines(clew("events", left, "--json").out).find(({ kind }) => kind !== "landmark").tick;
    await page.keyboard.press("n");
    assert.equal(await page.evaluate(() => window.clew.session.tick), first);
    await page.keyboard.press(" ");
    await page.waitForFunction((tick) => window.clew.session.tick > tick + 3, first);
    await page.keyboard.press(" ");
    assert.equal(await page.evaluate(() => window.clew.session.playing), false);
  });

  await context.test("the mouse scrubs, zooms and measures", async () => {
    const lanes = await page.locator("#lanes").boundingBox();
    await page.mouse.click(lanes.x + lanes.width - 12, lanes.y + 8);
    assert.equal(await page.evaluate(() => window.clew.session.tick), await page.evaluate(() => window.clew.session.last_tick));
    await page.click("#measure");
    const place = (x, y) => page.evaluate(([px, py]) => window.clew.map.place(px, py), [x, y]);
    const [from, to] = [await place(300, 200), await place(400, 200)];
    const map = await page.locator("#map-canvas").boundingBox();
    await page.mouse.move(map.x + 300, map.y + 200);
    await page.mouse.down();
    await page.mouse.move(map.x + 400, map.y + 200);
    await page.mouse.up();
    const ruler = await page.evaluate(() => window.clew.map.measured);
    assert.ok(Math.abs(ruler - (to[0] - from[0])) < 1e-6);
    await page.keyboard.press("m");
    await page.mouse.wheel(0, -300);
    await page.waitForFunction((width) => window.clew.map.place(400, 200)[0] - window.clew.map.place(300, 200)[0] < width, 0.9 * (to[0] - from[0]));
  });

  assert.deepEqual(complaints, []);
});

test("nobody but the page gets anything", async (context) => {
  const [left] = record(scratch_directory(context));
  const { port, token } = await serve(context, "view", left);
  const cookie = { Cookie: `clew_view_${port}=${token}` };

  const page = await request(port, `/?token=${token}`);
  assert.equal(page.status, 200);
  assert.match(page.headers["content-security-policy"], /default-src 'none'; script-src 'sha256-[^']+'; .*frame-ancestors 'none'/);
  assert.equal(page.headers["referrer-policy"], "no-referrer");
  assert.match(page.headers["set-cookie"][0], /HttpOnly; SameSite=Strict/);

  assert.deepEqual((await request(port, "/recordings/0", cookie)).body, readFileSync(left));
  const piece = await request(port, "/recordings/0", { ...cookie, Range: "bytes=10-19" });
  assert.equal(piece.status, 206);
  assert.deepEqual(piece.body, readFileSync(left).subarray(10, 20));

  const refused = async (expected, target, headers, method, body) =>
    assert.equal((await request(port, target, headers, method, body)).status, expected, `${method ?? "GET"} ${target} ${JSON.stringify(headers)}`);
  await refused(403, "/", {});
  await refused(403, "/recordings/0", { Cookie: `clew_view_${port}=${"0".repeat(32)}` });
  await refused(403, "/recordings/0", { ...cookie, Host: "evil.example" });
  await refused(403, "/recordings/0", { ...cookie, Origin: "http://evil.example" });
  await refused(403, "/session", cookie, "POST", "{}");
  await refused(404, "/session", { ...cookie, Origin: `http://127.0.0.1:${port}` }, "POST", "{}");
  for (const target of ["/recordings/1", "/recordings/-1", "/recordings/0/..", "/../../etc/passwd", "/recordings/..%2f..%2fetc%2fpasswd", "/recordings/18446744073709551616"]) {
    await refused(404, target, cookie);
  }
  await refused(405, "/", cookie, "DELETE");
  await refused(413, "/session", { ...cookie, Origin: `http://127.0.0.1:${port}` }, "POST", "x".repeat(2 << 20)).catch((error) => assert.match(String(error), /EPIPE|ECONNRESET/));
  await refused(400, "/", { ...cookie, Origin: `http://127.0.0.1:${port}`, Connection: "Upgrade", Upgrade: "websocket", "Sec-WebSocket-Key": "AAAAAAAAAAAAAAAAAAAAAA==", "Sec-WebSocket-Version": "13" });

  await context.test("three hundred clients at once are answered", async () => {
    const answers = await Promise.all(Array.from({ length: 300 }, () => request(port, "/session", cookie).then(({ status }) => status, () => 0)));
    assert.ok(answers.filter((status) => status === 200).length >= 100);
    await refused(200, "/session", cookie);
  });
});

test("a command that cannot be carried out says why", () => {
  assert.equal(clew("view", "no-such-file.mcap").status, 2);
  assert.match(clew("view", "no-such-file.mcap").err, /no-such-file\.mcap/);
  assert.equal(clew("view", "--port", "70000").status, 2);
});
