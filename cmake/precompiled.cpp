// SPDX-License-Identifier: Apache-2.0
// A target needs a source; what it is for is its precompiled header.
