// SPDX-License-Identifier: Apache-2.0
// What somebody who looks on costs a run, and how long somebody who asks what if waits:
//   CLEW_COMMAND=build/clew CLEW_PAGE_DIR=build/tools/view/page node tests/benchmarks/view_benchmark.mjs [ROUNDS [TICKS]]
// In each round a run of five processes goes alone, recorded, watched, and recorded and watched, in
// turn; told are the medians of the rates, and of the rounds' ratios, with their range.
import { spawn, spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, statSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import path from "node:path";
import { createInterface } from "node:readline";
import { gzipSync } from "node:zlib";

const page_directory = path.resolve(process.env.CLEW_PAGE_DIR);
const require = createRequire(`${page_directory}/`);
const { chromium } = require("playwright-core");
const { WebSocket } = require("ws");
const kClew = path.resolve(process.env.CLEW_COMMAND);
const rounds = Number(process.argv[2] ?? 7);
const ticks = process.argv[3] ?? "20000";
const directory = mkdtempSync(path.join(tmpdir(), "clew-view-"));
const recording = path.join(directory, "run.mcap");
/// The robot wanders before a wall for as long as it is let.
const kRun = ["run", "krishna_kalra", "--world", "unsolvable-behind-wall", "--with", "recover.detector=none", "--json"];

/// Reads a run as a page does, the newest tick sixty times a second; the bytes that came.
function look_on(line) {
  const { port, searchParams } = new URL(line.split(" ")[1]);
  const counted = { bytes: 0 };
  const socket = new WebSocket(`ws://127.0.0.1:${port}/live`, ["clew.view.v1"], {
    headers: { Cookie: `clew_view_${port}=${searchParams.get("token")}`, Origin: `http://127.0.0.1:${port}` },
  });
  socket.on("message", (data, is_binary) => {
    counted.bytes += data.length;
    if (!is_binary && JSON.parse(data).ended) socket.send('{"has_all": true}');
  });
  socket.on("error", (error) => { throw error; });
  return counted;
}

/// Runs it; ticks a second, the hash, and what a viewer got.
async function rate_of({ recorded, watched }) {
  const words = [...kRun, "--max-ticks", ticks, ...(recorded ? ["--record", recording, "--force"] : []), ...(watched ? ["--view"] : [])];
  const run = spawn(kClew, words, { stdio: ["ignore", "pipe", "inherit"] });
  const lines = createInterface({ input: run.stdout });
  let report;
  let seen = { bytes: 0 };
  lines.on("line", (line) => {
    if (line.startsWith("view ")) seen = look_on(line);
    else report = JSON.parse(line);
  });
  await new Promise((resolve) => lines.once("close", resolve));
  if (!(report?.ticks_per_s > 0)) throw new Error(`no rate: ${JSON.stringify(report)}`);
  if (watched && seen.bytes === 0) console.log("view: the run was over before its viewer had come");
  return { rate: report.ticks_per_s, hash: report.hash };
}

function median(values) {
  const sorted = [...values].sort((a, b) => a - b);
  return sorted[Math.floor(sorted.length / 2)];
}

/// How much of the rate `what` costs beside `beside`, in per cent, round by round.
function cost(rates, what, beside) {
  return rates[what].map((rate, i) => 100 * (1 - rate / rates[beside][i]));
}
const told = (values) => `${median(values).toFixed(1)} % [${Math.min(...values).toFixed(1)}, ${Math.max(...values).toFixed(1)}]`;

async function measure_costs() {
  const kinds = { alone: {}, recorded: { recorded: true }, watched: { watched: true }, both: { recorded: true, watched: true } };
  const rates = Object.fromEntries(Object.keys(kinds).map((name) => [name, []]));
  const hashes = new Set();
  for (let round = 0; round < rounds; round++) {
    const order = round % 2 === 0 ? Object.keys(kinds) : Object.keys(kinds).reverse();
    for (const name of order) {
      const { rate, hash } = await rate_of(kinds[name]);
      rates[name].push(rate);
      hashes.add(hash);
    }
  }
  if (hashes.size !== 1) throw new Error(`${hashes.size} hashes of one run`);
  for (const [name, of] of Object.entries(rates)) console.log(`view/rate/${name}: ${Math.round(median(of))} ticks/s`);
  console.log(`view/cost/viewer beside a recorded run: ${told(cost(rates, "both", "recorded"))} in ${rounds} rounds (at most 3 %)`);
  const more = cost(rates, "watched", "alone").map((each, i) => each - cost(rates, "recorded", "alone")[i]);
  console.log(`view/cost/viewer less recorder, beside a run alone: ${told(more)} (at most 5 %)`);
}

/// The file of a report beside the recording, packed as it comes.
function measure_report() {
  const packed = path.join(directory, "packed.mcap");
  const output = path.join(directory, "report.html");
  spawnSync(kClew, [...kRun, "--layout", "composed", "--max-ticks", ticks, "--compression", "zstd", "--record", packed], { stdio: "ignore" });
  spawnSync(kClew, ["report", packed, "-o", output], { stdio: "inherit" });
  const [of_report, of_recording] = [output, packed].map((file) => statSync(file).size);
  console.log(`view/report of ${ticks} ticks: ${(of_report / 1000).toFixed(0)} kB (at most ${((1.5 * of_recording + 400000) / 1000).toFixed(0)} kB: 1.5 times the recording and 400 kB)`);
}

/// From the press of the key to the frame in which the new path is drawn, in milliseconds.
async function measure_branch() {
  spawnSync(kClew, [...kRun, "--layout", "composed", "--max-ticks", "1200", "--record", recording, "--force"], { stdio: "ignore" });
  const server = spawn(kClew, ["view", recording], { stdio: ["ignore", "pipe", "inherit"] });
  const browser = await chromium.launch({ executablePath: process.env.CLEW_CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
  try {
    const line = await new Promise((resolve) => createInterface({ input: server.stdout }).once("line", resolve));
    const page = await browser.newPage({ viewport: { width: 1280, height: 860 } });
    await page.goto(line.split(" ")[1]);
    await page.waitForSelector("body[data-ready]", { timeout: 60000 });
    const times = [];
    for (let i = 0; i < Math.max(rounds, 3); i++) {
      times.push(await page.evaluate(async () => {
        const { session } = window.clew;
        session.go_to(200);
        document.querySelector("input[aria-label='Most ticks']").value = "1200";
        const before = session.runs.length;
        const begun = performance.now();
        document.body.dispatchEvent(new KeyboardEvent("keydown", { key: "b", bubbles: true }));
        const frame = () => new Promise((resolve) => requestAnimationFrame(resolve));
        while (session.runs.length === before || session.runs[before].last_tick < 1200) {
          if (performance.now() - begun > 60000) throw new Error("no branch of 1000 ticks within 60 s");
          await frame();
        }
        await frame();
        return performance.now() - begun;
      }));
    }
    console.log(`view/branch of 1000 ticks on the screen: median ${median(times).toFixed(0)} ms, ${Math.min(...times).toFixed(0)} to ${Math.max(...times).toFixed(0)} ms (at most 300 ms)`);
  } finally {
    await browser.close();
    server.kill("SIGTERM");
  }
}

try {
  const size = gzipSync(readFileSync(path.join(page_directory, "page.html")), { level: 9 }).length;
  console.log(`view/page: ${(size / 1000).toFixed(0)} kB compressed (at most 250 kB)`);
  measure_report();
  await measure_costs();
  await measure_branch();
} finally {
  rmSync(directory, { recursive: true, force: true });
}
