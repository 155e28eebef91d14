// The C tracer as a JavaScript object: what its C library asks of an operating system, and the functions of
// page_module.c. Runs in the page and in its workers.
'use strict';

// Paths are compared without "./", doubled slashes and "folder/..".
function normalPath(path) {
    const parts = [];
    for (const part of path.split('/'))
        if (part === '..' && parts.length && parts[parts.length - 1] !== '..') parts.pop();
        else if (part !== '' && part !== '.') parts.push(part);
    return parts.join('/');
}

// WASI, as far as reading files and writing to memory needs it. files: Map of path -> Uint8Array; there is nothing to
// write to.
function wasiOf(files, memoryOf) {
    const OK = 0;
    const BAD_FILE = 8;
    const NO_ENTRY = 44;
    const FOLDER_TYPE = 3;
    const FILE_TYPE = 4;
    const ROOT = 3;
    const open = new Map(); // descriptor -> {bytes, at, folder}
    let next = ROOT + 1;
    const view = () => new DataView(memoryOf());
    const textAt = (at, length) => new TextDecoder().decode(new Uint8Array(memoryOf(), at, length).slice());
    const isFolder = path => path === '' || [...files.keys()].some(name => name.startsWith(path + '/'));
    // A struct filestat: the kind, one link, the size.
    const tellFile = (bytes, folder, out) => {
        new Uint8Array(memoryOf(), out, 64).fill(0);
        view().setUint8(out + 16, folder ? FOLDER_TYPE : FILE_TYPE);
        view().setBigUint64(out + 24, 1n, true);
        view().setBigUint64(out + 32, BigInt(bytes.length), true);
        return OK;
    };
    return {
        fd_prestat_get(fd, out) {
            if (fd !== ROOT) return BAD_FILE;
            view().setUint32(out, 0, true);
            view().setUint32(out + 4, 1, true); // the length of "/"
            return OK;
        },
        fd_prestat_dir_name(fd, out) {
            new Uint8Array(memoryOf())[out] = '/'.charCodeAt(0);
            return OK;
        },
        fd_fdstat_get(fd, out) {
            if (fd !== ROOT && !open.has(fd)) return BAD_FILE;
            new Uint8Array(memoryOf(), out, 8).fill(0);
            view().setUint8(out, fd === ROOT ? FOLDER_TYPE : FILE_TYPE);
            view().setBigUint64(out + 8, 0xffffffffffffffffn, true);
            view().setBigUint64(out + 16, 0xffffffffffffffffn, true);
            return OK;
        },
        fd_fdstat_set_flags: () => OK,
        fd_filestat_get(fd, out) {
            const file = open.get(fd);
            return file ? tellFile(file.bytes, file.folder, out) : BAD_FILE;
        },
        path_filestat_get(fd, lookup, path, length, out) {
            const name = normalPath(textAt(path, length));
            const bytes = files.get(name);
            return bytes || isFolder(name) ? tellFile(bytes || new Uint8Array(), !bytes, out) : NO_ENTRY;
        },
        path_open(fd, lookup, path, length, flags, rights, inheriting, more, out) {
            const name = normalPath(textAt(path, length));
            const bytes = files.get(name);
            if (!bytes && !isFolder(name)) return NO_ENTRY;
            open.set(next, {bytes: bytes || new Uint8Array(), at: 0, folder: !bytes});
            view().setUint32(out, next++, true);
            return OK;
        },
        fd_read(fd, vectors, count, out) {
            const file = open.get(fd);
            if (!file) return BAD_FILE;
            let read = 0;
            for (let i = 0; i < count; i++) {
                const at = view().getUint32(vectors + 8 * i, true);
                const room = view().getUint32(vectors + 8 * i + 4, true);
                const part = file.bytes.subarray(file.at, file.at + room);
                new Uint8Array(memoryOf()).set(part, at);
                file.at += part.length;
                read += part.length;
            }
            view().setUint32(out, read, true);
            return OK;
        },
        fd_seek(fd, offset, whence, out) {
            const file = open.get(fd);
            if (!file) return BAD_FILE;
            file.at = Number(offset) + [0, file.at, file.bytes.length][whence];
            view().setBigUint64(out, BigInt(file.at), true);
            return OK;
        },
        fd_close: fd => (open.delete(fd) ? OK : BAD_FILE),
        fd_readdir: () => BAD_FILE, // there are no folders to look through
        fd_write: () => BAD_FILE,
        clock_time_get(id, precision, out) {
            view().setBigUint64(out, BigInt(Math.round(performance.now() * 1e6)), true);
            return OK;
        },
        proc_exit(code) {
            throw new Error('the tracer ended with status ' + code);
        },
    };
}

// PageFormat of page.h
const FORMATS = ['text', 'json', 'obj', 'svg', 'steps', 'textbook', 'textbook-steps'];

class Tracer {
    // module: a compiled WebAssembly.Module; files: Map of normal path -> Uint8Array, which may change later.
    static async make(module, files) {
        const self = new Tracer();
        const wasi = wasiOf(files, () => self.c.memory.buffer);
        self.c = (await WebAssembly.instantiate(module, {wasi_snapshot_preview1: wasi})).exports;
        self.c._initialize();
        return self;
    }

    textAt(at) {
        const bytes = new Uint8Array(this.c.memory.buffer, at);
        return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
    }

    fail() {
        throw new Error(this.textAt(this.c.page_error()));
    }

    value(name) {
        return this.c.page_value(
            ['columns', 'rows', 'grid', 'adaptive', 'faces', 'lights', 'low', 'high', 'length'].indexOf(name),
        );
    }

    // Throws an Error with the program's message: file, line, column, reason, caret. The scene before stays then.
    open(path) {
        const bytes = new TextEncoder().encode(path + '\0');
        const at = this.c.page_alloc(bytes.length);
        new Uint8Array(this.c.memory.buffer).set(bytes, at);
        const done = this.c.page_open(at);
        this.c.page_free(at);
        if (!done) this.fail();
    }

    // arithmetic: a PageArithmetic of page.h; tree: an AccelKind of render.h
    set({columns = 0, rows = 0, grid = 0, adaptive = false, arithmetic = 0, tree = 1}) {
        this.c.page_set(columns, rows, grid, adaptive ? 1 : 0, arithmetic, tree);
    }

    pixelsAt(at, rows) {
        if (!at) this.fail();
        return new Uint8ClampedArray(this.c.memory.buffer, at, this.value('columns') * rows * 4).slice();
    }

    rows(first, count, step) {
        return this.pixelsAt(this.c.page_rows(first, count, step), count);
    }

    // kind: a MapKind of render.h
    map(kind) {
        return this.pixelsAt(this.c.page_map(kind), this.value('rows'));
    }

    trace(column, row, format = 'text', {sample = 0, verbose = false, colour = false, columns = 0} = {}) {
        const number = FORMATS.indexOf(format);
        const flags = (verbose ? 1 : 0) + (colour ? 2 : 0);
        const at = this.c.page_trace(column, row, sample, number, flags, columns);
        return this.writtenAt(at);
    }

    // The text in which page_module.c says it.
    writtenAt(at) {
        if (!at) this.fail();
        return new TextDecoder().decode(new Uint8Array(this.c.memory.buffer, at, this.value('length')));
    }

    // Where two pixels part.
    diff(one, other, columns = 0) {
        return this.writtenAt(this.c.page_diff(...one, ...other, columns));
    }

    numbers(count) {
        return new Float32Array(this.c.memory.buffer, this.c.page_numbers(), count).slice();
    }
    faces() {
        return this.numbers(this.c.page_faces());
    }
    places() {
        return this.numbers(this.c.page_places());
    }
    seen() {
        return this.numbers(this.c.page_seen());
    }
    // red * 65536 + green * 256 + blue
    bytes(column, row, arithmetic) {
        return this.c.page_bytes(column, row, arithmetic);
    }

    lines(column, row, sample = 0) {
        return this.numbers(this.c.page_lines(column, row, sample));
    }
    tested(column, row, hit, light, sample = 0) {
        return this.numbers(this.c.page_tested(column, row, sample, hit, light));
    }
    // {numbers, words: what the program says of each}
    nodes(column, row, hit, light) {
        const numbers = this.numbers(this.c.page_nodes(column, row, hit, light));
        const words = this.writtenAt(this.c.page_text()).trimEnd().split('\n');
        return {numbers, words: words.map(line => line.trim())};
    }

    nodeVerdict(number) {
        return this.textAt(this.c.page_node_verdict(number));
    }

    faceName(face) {
        return this.textAt(this.c.page_face_name(face));
    }
    verdict(number) {
        return this.textAt(this.c.page_verdict(number));
    }
}
