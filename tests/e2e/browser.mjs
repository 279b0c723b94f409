// SPDX-License-Identifier: Apache-2.0
// The browser of the tests: Chromium without a window, which takes two thirds of the time of the whole one. A page lives for
// seconds: optimising its scripts and collecting their garbage costs a fifth of the time and gains nothing.
import {existsSync} from 'node:fs';
import {createRequire} from 'node:module';
import {dirname, join, resolve} from 'node:path';
import {fileURLToPath} from 'node:url';

const npm = process.env.TRUEAXIS_NPM ?? join(dirname(fileURLToPath(import.meta.url)), '../../build/npm');
const {chromium} = createRequire(join(resolve(npm), 'node_modules/'))('playwright-core');

export const launch = () => chromium.launch({
  executablePath: process.env.TRUEAXIS_CHROMIUM ?? ['/usr/bin/chromium-headless-shell', '/usr/bin/chromium'].find(existsSync),
  args: ['--no-sandbox', '--disable-gpu', '--disable-background-networking', '--disable-component-update', '--disable-sync',
    '--no-first-run', '--disable-default-apps', '--force-device-scale-factor=1', '--js-flags=--no-opt,--min-semi-space-size=32'],
});
