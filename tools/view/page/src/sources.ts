// SPDX-License-Identifier: Apache-2.0
// Where recordings come from: the server that serves this page, or the page itself if it is a
// report.

import { McapFeed, Recording } from "./recording";

export interface ServedRecording {
  id: number;
  name: string;
  /// How many; more than one if it is split.
  files: number;
}

/// What the server says there is.
export interface Served {
  recordings: ServedRecording[];
  /// Whether a run is under way.
  live: boolean;
}

export async function read_session(): Promise<Served> {
  return await (await fetch("session")).json() as Served;
}

/// The first piece is small: what somebody sees at once is made of it. Then each is twice as large.
const kFirstPiece = 128 << 10;
const kPiece = 4 << 20;

/// Nothing between two pieces would let the page answer.
const breathe = (): Promise<void> => new Promise((resolve) => setTimeout(resolve, 0));

/// Reads a recording piece by piece. `on_piece` is called when more of it is there.
export async function read_served(id: number, files: number, recording: Recording, on_piece: () => void): Promise<void> {
  for (let file = 0; file < files; file++) await read_file(`recordings/${id}/${file}`, recording, on_piece);
}

async function read_file(address: string, recording: Recording, on_piece: () => void): Promise<void> {
  const feed = new McapFeed(recording);
  for (let start = 0, size = Infinity, piece = kFirstPiece; start < size; piece = Math.min(2 * piece, kPiece)) {
    const answer = await fetch(address, { headers: { Range: `bytes=${start}-${start + piece - 1}` } });
    if (answer.status === 416) return;
    if (!answer.ok) throw new Error(`${answer.status}: ${await answer.text()}`);
    const total = /\/(\d+)$/.exec(answer.headers.get("Content-Range") ?? "")?.[1];
    const bytes = new Uint8Array(await answer.arrayBuffer());
    size = total === undefined ? bytes.length : Number(total);
    if (bytes.length === 0) return;
    start += bytes.length;
    feed.append(bytes);
    on_piece();
    await breathe();
  }
}

export async function read_embedded(files: Uint8Array[], recording: Recording, on_piece: () => void): Promise<void> {
  for (const bytes of files) {
    const feed = new McapFeed(recording);
    for (let start = 0, piece = kFirstPiece; start < bytes.length; piece = Math.min(2 * piece, kPiece)) {
      feed.append(bytes.subarray(start, start + piece));
      start += piece;
      on_piece();
      await breathe();
    }
  }
}
