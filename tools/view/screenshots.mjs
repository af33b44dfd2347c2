// SPDX-License-Identifier: Apache-2.0
// Makes the pictures of the page in docs/pictures, from the built command and in Debian's Chromium:
//   node tools/view/screenshots.mjs [NAME]...     trap, branch, vendors, narrow, landscape; all
import { spawn, spawnSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import path from "node:path";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";

const kSource = path.resolve(path.dirname(fileURLToPath(import.meta.url)), "../..");
const kClew = path.resolve(process.env.CLEW_COMMAND ?? path.join(kSource, "build/clew"));
const { chromium } = createRequire(`${kSource}/build/tools/view/page/`)("playwright-core");
const directory = mkdtempSync(path.join(tmpdir(), "clew-screenshots-"));

/// Records a run, or whatever the words say; the file.
function record(name, ...words) {
  const file = path.join(directory, `${name}.mcap`);
  const done = spawnSync(kClew, [...words, "--record", file], { encoding: "utf8" });
  if (![0, 3, 5].includes(done.status)) throw new Error(`clew ${words.join(" ")}: ${done.stderr}`);
  return file;
}

const kComposed = ["--layout", "composed"];
// What is recorded, the tick that is shown, the panel, and what else is done on the page.
const kSituations = {
  trap: { runs: () => [record("trap", "run", "krishna_kalra", ...kComposed)], tick: 150, panel: "Overview" },
  branch: {
    runs: () => {
      const stuck = record("stuck", "run", "krishna_kalra", "--with", "recover.detector=none", "--max-ticks", "250", ...kComposed);
      return [stuck, record("branched", "replay", stuck, "--with", "recover.detector=landmark_revisit", "--branch", "112", "--max-ticks", "1000")];
    },
    tick: 250, panel: "What if",
  },
  vendors: {
    runs: () => ["cyclonedds", "fastdds"].map((vendor) => record(vendor, "run", "default", "--middleware", vendor)),
    tick: 120, panel: "Messages",
  },
  narrow: {
    runs: () => [record("narrow", "run", "nakhaeinia", "--world", "n-fig02-nvt-cluttered", "--max-ticks", "400", ...kComposed)],
    tick: 60, panel: "Insides", open: "control",
  },
  landscape: {
    runs: () => [record("landscape", "run", "lagoudakis_maida", "--max-ticks", "200", ...kComposed)],
    tick: 15, panel: "Insides", open: "control", without: ["scan"], size: [940, 580],
  },
};

/// Opens the values of one stage, all groups of them, and brings what is drawn of them into view.
async function open_values(page, stage) {
  await page.waitForFunction((name) => [...document.querySelectorAll("h2")].some((each) => each.textContent.toLowerCase().startsWith(name)), stage);
  const in_section = ([name, bring]) => {
    const head = [...document.querySelectorAll("h2")].find((each) => each.textContent.toLowerCase().startsWith(name));
    let drawing;
    for (let next = head.nextElementSibling; next && next.tagName !== "H2"; next = next.nextElementSibling) {
      for (const group of [next, ...next.querySelectorAll("details")]) if (group.tagName === "DETAILS") group.open = true;
      // A landscape tells more than a list.
      drawing = next.querySelector('canvas[aria-label*=" rows by "]') ?? drawing ?? next.querySelector("canvas");
    }
    if (bring) (drawing ?? head).scrollIntoView({ block: "center" });
  };
  // A group draws what is in it when it is opened.
  for (const bring of [false, false, true]) {
    await page.evaluate(in_section, [stage, bring]);
    await page.waitForTimeout(300);
  }
}

async function take(browser, name, { runs, tick, panel, open, without = [], size: [width, height] = [1120, 700] }) {
  const server = spawn(kClew, ["view", ...runs()], { stdio: ["ignore", "pipe", "inherit"] });
  const line = await new Promise((resolve) => createInterface({ input: server.stdout }).once("line", resolve));
  const page = await browser.newPage({ viewport: { width, height } });
  await page.goto(line.split(" ")[1]);
  await page.waitForSelector("body[data-ready]");
  await page.evaluate((wanted) => window.clew.session.go_to(wanted), tick);
  await page.getByRole("button", { name: panel, exact: true }).or(page.getByRole("tab", { name: panel, exact: true })).first().click();
  // What lies over a landscape makes the picture large; pictures have at most 150 kB.
  for (const layer of without) await page.evaluate((each) => document.querySelector(`[data-layer=${each}]`).click(), layer);
  if (open) await open_values(page, open);
  await page.waitForTimeout(1000);
  await page.screenshot({ path: path.join(kSource, "docs/pictures", `${name}.png`) });
  await page.close();
  server.kill("SIGTERM");
}

const browser = await chromium.launch({ executablePath: process.env.CLEW_CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
try {
  for (const name of process.argv.length > 2 ? process.argv.slice(2) : Object.keys(kSituations)) {
    if (!kSituations[name]) throw new Error(`unknown situation '${name}'; allowed: ${Object.keys(kSituations).join(", ")}`);
    await take(browser, name, kSituations[name]);
  }
} finally {
  await browser.close();
  rmSync(directory, { recursive: true, force: true });
}
