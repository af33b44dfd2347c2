// SPDX-License-Identifier: Apache-2.0
// How long a frame of `clew view` takes while somebody scrubs through a long recording:
//   CLEW_COMMAND=build/clew CLEW_PAGE_DIR=build/tools/view/page node tests/benchmarks/scrub_benchmark.mjs [TICKS]
// Prints the time to the first picture, the script's work in a frame and the time from frame to frame.
import { spawn, spawnSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import path from "node:path";
import { createInterface } from "node:readline";

const { chromium } = createRequire(`${path.resolve(process.env.CLEW_PAGE_DIR)}/`)("playwright-core");
const kClew = path.resolve(process.env.CLEW_COMMAND);
const kFrames = 100;

/// In the page: jumps to `frames` ticks, one a frame; milliseconds of each frame's work and period.
async function scrub(frames) {
  const { session } = window.clew;
  const span = session.last_tick - session.first_tick;
  const frame = () => new Promise((resolve) => requestAnimationFrame(() => resolve(performance.now())));
  const work = [];
  const period = [];
  let before = await frame();
  for (let i = 0; i < frames; i++) {
    // Callbacks of one frame run in the order in which they were asked for.
    const begin = frame();
    session.go_to(session.first_tick + Math.floor(span * ((i * 0.618034) % 1)));
    const end = frame();
    work.push((await end) - (await begin));
    const now = await begin;
    period.push(now - before);
    before = now;
  }
  return { work, period: period.slice(1) };
}

function quantiles(values) {
  const sorted = [...values].sort((a, b) => a - b);
  const at = (share) => sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))].toFixed(1);
  return `median ${at(0.5)} ms, p99 ${at(0.99)} ms`;
}

/// In the page, before its script: when the map has drawn a run for the first time.
function watch_for_picture() {
  const look = () => {
    if (window.clew?.session.runs[0]?.ticks.length > 0) requestAnimationFrame(() => { window.first_picture_ms = performance.now(); });
    else requestAnimationFrame(look);
  };
  requestAnimationFrame(look);
}

const ticks = process.argv[2] ?? "100000";
const directory = mkdtempSync(path.join(tmpdir(), "clew-scrub-"));
const file = path.join(directory, "long.mcap");
spawnSync(kClew, ["run", "krishna_kalra", "--world", "unsolvable-behind-wall", "--with", "recover.detector=none", "--max-ticks", ticks,
  "--layout", "composed", "--record", file], { stdio: "ignore" });
const server = spawn(kClew, ["view", file], { stdio: ["ignore", "pipe", "inherit"] });
const browser = await chromium.launch({ executablePath: process.env.CLEW_CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
try {
  const line = await new Promise((resolve) => createInterface({ input: server.stdout }).once("line", resolve));
  const page = await browser.newPage({ viewport: { width: 1280, height: 860 } });
  await page.addInitScript(watch_for_picture);
  const begin = performance.now();
  await page.goto(line.split(" ")[1]);
  await page.waitForSelector("body[data-ready]", { timeout: 120000 });
  console.log(`first picture after ${((await page.evaluate(() => window.first_picture_ms)) / 1000).toFixed(2)} s (at most 1 s)`);
  console.log(`${ticks} ticks read after ${((performance.now() - begin) / 1000).toFixed(2)} s`);
  await page.evaluate(scrub, 20);
  const { work, period } = await page.evaluate(scrub, kFrames);
  console.log(`a frame's work: ${quantiles(work)} (median at most 8 ms)`);
  console.log(`from frame to frame: ${quantiles(period)} (16.7 ms are 60 a second)`);
  if (process.argv[3]) await page.screenshot({ path: process.argv[3] });
} finally {
  await browser.close();
  server.kill("SIGTERM");
  rmSync(directory, { recursive: true, force: true });
}
