// schema.cjs GLINT SCRATCH: ajv and glint validate agree on every instance below, and the schema is one of draft 2020-12.
'use strict';
const fs = require('fs');
const path = require('path');
const { spawnSync } = require('child_process');
const Ajv = require('ajv/dist/2020');

const [glint, scratch] = process.argv.slice(2);
const root = path.resolve(__dirname, '../..');
const schema = JSON.parse(fs.readFileSync(
    path.join(root, 'exporters/gltf/GLINT_materials_glint/schema/material.GLINT_materials_glint.schema.json')));

// The parts of Khronos' own schemas that ours refers to.
const ajv = new Ajv({ strict: true, strictRequired: false, allErrors: true });
ajv.addSchema({ $id: 'glTFProperty.schema.json', type: 'object', properties: { extensions: { type: 'object' }, extras: {} } });
ajv.addSchema({
    $id: 'textureInfo.schema.json', type: 'object', required: ['index'],
    properties: { index: { type: 'integer', minimum: 0 }, texCoord: { type: 'integer', minimum: 0 }, extensions: { type: 'object' } },
});
const check = ajv.compile(schema);

const texture = { index: 0 };
const valid = [
    {}, { glintFactor: 0 }, { glintFactor: 1, glintTexture: texture }, { glintDistribution: 'beckmann' }, { glintDensity: 1e-3 },
    { glintDensityTexture: { index: 0, texCoord: 1 } }, { glintFacetRoughness: 1 }, { glintColorFactor: [0, 0.5, 1] },
    { glintColorTexture: texture }, { glintColorVariation: 1 }, { glintColors: [[1, 0, 0.5]] }, { glintElongation: 1 }, { glintCoverage: 0 },
    { glintDensityVariation: 0 }, { glintSpace: 'object' }, { glintTexCoord: 1 }, { glintUvScale: 0.01 },
    { glintLayer: 'clearcoat' }, { glintSeed: 2147483647 }, { glintStructure: 'example', glintExampleTexture: texture },
    { glintExamplePlacement: 'scattered' }, { glintExampleSize: 1 }, { somethingElse: 1 }, { extras: 1 },
    { extensions: { X: {} } },
];
const invalid = [
    { glintFactor: -0.1 }, { glintFactor: 1.1 }, { glintFactor: '1' }, { glintTexture: {} }, { glintTexture: { index: -1 } },
    { glintTexture: { index: 0.5 } }, { glintDistribution: 'GGX' }, { glintDistribution: 1 }, { glintDensity: 0 },
    { glintDensity: null }, { glintDensityTexture: [] }, { glintFacetRoughness: 1.5 }, { glintColorFactor: [1, 1] },
    { glintColorFactor: [1, 1, 1, 1] }, { glintColorFactor: [1, 1, 2] }, { glintColorFactor: 1 }, { glintColorTexture: 0 },
    { glintColorVariation: -1 }, { glintColors: [] }, { glintColors: [[1, 0]] }, { glintColors: [[2, 0, 0]] },
    { glintColors: Array(9).fill([1, 1, 1]) }, { glintElongation: 0.5 }, { glintCoverage: 2 }, { glintDensityVariation: -1 },
    { glintSpace: 'world' }, { glintTexCoord: 2 }, { glintTexCoord: 0.5 }, { glintUvScale: 0 }, { glintLayer: 'coat' },
    { glintSeed: -1 }, { glintSeed: 2147483648 }, { glintSeed: 1.5 }, { glintStructure: 'scratches' },
    { glintStructure: 'example' }, { glintExampleTexture: true }, { glintExamplePlacement: 'random' }, { glintExampleSize: 0 },
    { extensions: 1 },
];

function fileOf(number) {
    return path.join(scratch, `${number}.gltf`);
}

function write(instance, number) {
    fs.writeFileSync(fileOf(number), JSON.stringify({
        asset: { version: '2.0' }, extensionsUsed: ['GLINT_materials_glint'], images: [{ uri: 'data:image/png;base64,AAAA' }],
        textures: [{ source: 0 }], materials: [{ extensions: { GLINT_materials_glint: instance } }],
    }));
}

// One call for all files: it reports on each.
function checkAgreement(all) {
    const run = spawnSync(glint, ['validate', '--json', ...all.map((_, number) => fileOf(number))], { encoding: 'utf8' });
    if (run.status !== 1)
        throw new Error(`glint validate ended with ${run.status}: ${run.stderr}`);
    JSON.parse(run.stdout).files.forEach((report, number) => {
        if ((report.errors === 0) !== all[number].expected)
            throw new Error(`glint validate on ${JSON.stringify(all[number].instance)}: ${JSON.stringify(report)}`);
    });
}

fs.rmSync(scratch, { recursive: true, force: true });
fs.mkdirSync(scratch, { recursive: true });
const all = [...valid.map(instance => ({ instance, expected: true })), ...invalid.map(instance => ({ instance, expected: false }))];
all.forEach(({ instance, expected }, number) => {
    if (check(instance) !== expected)
        throw new Error(`ajv on ${JSON.stringify(instance)}: ${JSON.stringify(check.errors)}`);
    write(instance, number);
});
checkAgreement(all);
// Every property that the specification lists has a schema, and the other way round.
const text = fs.readFileSync(path.join(root, 'exporters/gltf/GLINT_materials_glint/README.md'), 'utf8');
const listed = [...text.matchAll(/^\| `(glint\w+)` \|/gm)].map(m => m[1]).filter((n, i, all) => all.indexOf(n) === i).sort();
const known = Object.keys(schema.properties).filter(n => n.startsWith('glint')).sort();
if (JSON.stringify(listed) !== JSON.stringify(known))
    throw new Error(`README.md lists ${listed}, the schema ${known}`);
// The presets follow it.
for (const file of fs.readdirSync(path.join(root, 'materials')).filter(f => f.endsWith('.gltf-material.json'))) {
    const preset = JSON.parse(fs.readFileSync(path.join(root, 'materials', file)));
    for (const layer of [preset, preset.extensions.KHR_materials_clearcoat || {}]) {
        const instance = (layer.extensions || {}).GLINT_materials_glint;
        if (instance && !check(instance))
            throw new Error(`${file}: ${JSON.stringify(check.errors)}`);
    }
}
console.log(`${all.length} instances, ${known.length} properties`);
