// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Prints errors and warnings of the Khronos glTF validator, one a line:
//   node khronos.js NODE_MODULES FILE.glb
const fs = require('fs');
const path = require('path');

const [modules, file] = process.argv.slice(2);
const validator = require(path.join(modules, 'gltf-validator'));
const kLeastSevere = 1;  // 0: error, 1: warning, 2: information, 3: hint

validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {maxIssues: 0}).then((report) => {
  for (const message of report.issues.messages) {
    if (message.severity > kLeastSevere) continue;
    console.log(`${message.code} ${message.pointer || ''}: ${message.message}`);
  }
});
