// khronos.cjs FILE...: what the Khronos validator says of each file; one JSON object a line: {file, errors, warnings, messages}.
// Errors and warnings that the file named by --before FILE has too are left out: an export does not mend its input.
'use strict';
const fs = require('fs');
const path = require('path');
const validator = require('gltf-validator');

async function issues(file) {
    const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {
        uri: file,
        maxIssues: 0,
        externalResourceFunction: uri => fs.promises.readFile(path.resolve(path.dirname(file), decodeURIComponent(uri))),
    });
    return report.issues.messages.filter(m => m.severity <= 1);
}

// Indices grow by what an export adds at the end, so a message is known by its code and its pointer.
const key = message => message.code + ' ' + message.pointer;

async function main(files) {
    let before = new Set(), bad = 0;
    for (let i = 0; i < files.length; i++) {
        if (files[i] === '--before') {
            before = new Set((await issues(files[++i])).map(key));
            continue;
        }
        const found = (await issues(files[i])).filter(m => !before.has(key(m)));
        before = new Set();
        for (const m of found)
            console.log(`${files[i]}: ${m.severity === 0 ? 'error' : 'warning'} ${m.code} at ${m.pointer}: ${m.message}`);
        bad += found.length;
    }
    return bad > 0 ? 1 : 0;
}

main(process.argv.slice(2)).then(code => process.exit(code), error => {
    console.error(error);
    process.exit(2);
});
