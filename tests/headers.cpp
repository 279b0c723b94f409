// SPDX-License-Identifier: Apache-2.0
// Empty: the precompiled headers of the tests belong to the target that compiles it.
