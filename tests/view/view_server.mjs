// SPDX-License-Identifier: Apache-2.0
// What the tests of the page have in common: the command, its recordings, a browser.
import { spawn, spawnSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import http from "node:http";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import path from "node:path";
import { createInterface } from "node:readline";

export const require = createRequire(`${process.env.CLEW_PAGE_DIR}/`);
const { chromium } = require("playwright-core");
const kClew = process.env.CLEW_COMMAND;

/// Runs the command to its end; what it printed.
export function clew(...words) {
  const done = spawnSync(kClew, words, { encoding: "utf8", maxBuffer: 1 << 28, timeout: 120000 });
  return { status: done.status, out: done.stdout, err: done.stderr };
}
export const json_lines = (text) => text.trim().split("\n").filter((line) => line !== "").map((line) => JSON.parse(line));

/// How many ticks a recording has.
export const ticks_of = (file) => json_lines(clew("echo", file, "state", "--jsonl", "--field", "outcome").out).length;

export function scratch_directory(context) {
  const directory = mkdtempSync(path.join(tmpdir(), "clew-view-test-"));
  context.after(() => rmSync(directory, { recursive: true, force: true }));
  return directory;
}

/// Starts a command that goes on; what it prints comes line by line.
export function start(context, ...words) {
  const child = spawn(kClew, words, { stdio: ["ignore", "pipe", "inherit"] });
  const ended = new Promise((resolve) => child.once("exit", resolve));
  context.after(async () => {
    child.kill("SIGTERM");
    await ended;
  });
  return { child, ended, lines: createInterface({ input: child.stdout }) };
}

/// Starts a command that serves a page; its address is the first line that it prints.
export async function serve(context, ...words) {
  const { child, ended, lines } = start(context, ...words);
  const first = await new Promise((resolve) => lines.once("line", resolve));
  const address = new URL(/^view (http:\/\/127\.0\.0\.1:\d+\/\?token=[0-9a-f]{32})$/.exec(first)[1]);
  return { child, ended, lines, address, port: Number(address.port), token: address.searchParams.get("token") };
}

export async function open_browser(context) {
  const browser = await chromium.launch({ executablePath: process.env.CLEW_CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
  context.after(() => browser.close());
  return browser;
}

/// Opens a page and waits until its recordings are read. Whatever it complains of fails the test.
export async function open_page(browser, address) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 860 } });
  const complaints = [];
  page.on("pageerror", (error) => complaints.push(String(error)));
  page.on("console", (message) => {
    if (message.type() === "error") complaints.push(message.text());
  });
  await page.goto(String(address));
  await page.waitForSelector("body[data-ready]", { timeout: 60000 });
  return { page, complaints };
}

/// A request by hand, with any headers; a browser would not send them.
export function request(port, target, headers = {}, method = "GET", body = "") {
  return new Promise((resolve, reject) => {
    const sent = http.request({ host: "127.0.0.1", port, path: target, method, headers, setHost: !("Host" in headers) }, (answer) => {
      const pieces = [];
      answer.on("data", (piece) => pieces.push(piece));
      answer.on("end", () => resolve({ status: answer.statusCode, headers: answer.headers, body: Buffer.concat(pieces) }));
    });
    sent.on("error", reject);
    sent.end(body);
  });
}
