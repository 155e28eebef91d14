// An edited scene as a part of the page's address, compressed where the browser can.
'use strict';

const PACKED_LIMIT = 32768; // letters: mail programs and course pages cut longer addresses

const packed = {text: '', turn: 0}; // what the address holds of the scene

const toUrl = bytes =>
    btoa(Array.from(bytes, byte => String.fromCharCode(byte)).join(''))
        .replace(/\+/g, '-')
        .replace(/\//g, '_')
        .replace(/=+$/, '');
const fromUrl = text => Uint8Array.from(atob(text.replace(/-/g, '+').replace(/_/g, '/')), c => c.charCodeAt(0));

async function through(bytes, stream) {
    return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());
}

async function pack(bytes) {
    if (typeof CompressionStream === 'undefined') return 'plain.' + toUrl(bytes);
    return 'gzip.' + toUrl(await through(bytes, new CompressionStream('gzip')));
}

async function unpack(text) {
    const [kind, data] = text.split('.');
    try {
        const bytes = fromUrl(data);
        return kind === 'gzip' ? await through(bytes, new DecompressionStream('gzip')) : bytes;
    } catch {
        throw new Error('The address holds an edited scene that cannot be read: a part of it is missing.');
    }
}

const isSame = (a, b) => Boolean(a && b) && a.length === b.length && a.every((byte, k) => byte === b[k]);
const isShipped = path => isSame(page.files.get(normalPath(path)), page.shipped.get(normalPath(path)));
const kilobytes = count => `${(count / 1024).toFixed(1)} KB`;

// What one should know who sends the address.
function packedNote(size) {
    const folder = page.path.replace(/[^/]*$/, '');
    const models = [...decode(fileOf(page.path)).matchAll(/"obj"\s*:\s*"([^"]+)"/g)];
    const lacks = models.some(([, name]) => !isShipped(folder + name));
    if (size > PACKED_LIMIT)
        return (
            `The address cannot hold this scene: it takes ${kilobytes(size)} there, and ${kilobytes(PACKED_LIMIT)} ` +
            'are the limit. Send the file, or a page that `rectray explore` makes of it.'
        );
    const held = `The address holds this edited scene, in ${kilobytes(size)}.`;
    return lacks ? held + ' Its models are not in it: send a page that `rectray explore` makes.' : held;
}

// Compressing takes a moment; an edit that comes meanwhile has the last word.
async function packScene() {
    const turn = ++packed.turn;
    packed.text = '';
    const shipped = isShipped(page.path);
    const text = shipped ? '' : await pack(fileOf(page.path));
    if (turn !== packed.turn) return;
    packed.text = text.length > PACKED_LIMIT ? '' : text;
    $('link-note').hidden = shipped;
    $('link-note').textContent = shipped ? '' : packedNote(text.length);
    $('link-note').classList.toggle('alarm', text.length > PACKED_LIMIT);
    $('restore').hidden = shipped || !page.shipped.has(normalPath(page.path));
    writeLink();
}

on('scene', packScene);
