// SPDX-License-Identifier: Apache-2.0
declare module "lz4js" {
  /// Unpacks an LZ4 frame.
  export function decompress(frame: Uint8Array, most_bytes?: number): Uint8Array | number[];
}
