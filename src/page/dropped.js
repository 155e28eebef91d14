// Own scenes and models: files and folders that are dropped or chosen.
'use strict';

// All files of a folder: [path, File]. Chromium gives a handle, others an entry; an entry's files cannot be read there
// by a page that was opened from a folder.
async function filesOfHandle(folder, path) {
    const found = [];
    for await (const [name, handle] of folder.entries())
        if (handle.kind === 'directory') found.push(...(await filesOfHandle(handle, path + name + '/')));
        else found.push([path + name, await handle.getFile()]);
    return found;
}

async function filesOfEntry(entry, path) {
    if (entry.isFile) return [[path + entry.name, await new Promise((give, fail) => entry.file(give, fail))]];
    const reader = entry.createReader();
    const found = [];
    for (let part; (part = await new Promise((give, fail) => reader.readEntries(give, fail))).length;)
        for (const child of part) found.push(...(await filesOfEntry(child, path + entry.name + '/')));
    return found;
}

// What a drop brings must be asked for at once; reading it may wait.
function itemOf(item) {
    const entry = item.webkitGetAsEntry ? item.webkitGetAsEntry() : null;
    if (!entry || !entry.isDirectory) return {file: item.getAsFile()};
    return {entry, handle: item.getAsFileSystemHandle && item.getAsFileSystemHandle()};
}

async function filesOf({file, entry, handle}) {
    if (!entry) return file ? [[file.name, file]] : [];
    return handle ? filesOfHandle(await handle, entry.name + '/') : filesOfEntry(entry, '');
}

// Models without their folders are put where the scene looks for them.
function settleModels(paths) {
    for (const path of paths.filter(name => name.endsWith('.json'))) {
        const folder = path.includes('/') ? path.replace(/[^/]*$/, '') : '';
        for (const [, name] of decode(page.files.get(path)).matchAll(/"obj"\s*:\s*"([^"]+)"/g)) {
            const wanted = normalPath(folder + name);
            const last = name.replace(/.*\//, '');
            const given = paths.find(other => other.replace(/.*\//, '') === last);
            if (!page.files.has(wanted) && given) page.files.set(wanted, page.files.get(given));
            for (const library of paths.filter(other => other.endsWith('.mtl')))
                page.files.set(
                    normalPath(wanted.replace(/[^/]*$/, '') + library.replace(/.*\//, '')),
                    page.files.get(library),
                );
        }
    }
}

async function takeFiles(files) {
    const paths = [];
    for (const [path, file] of files) {
        page.files.set(normalPath(path), new Uint8Array(await file.arrayBuffer()));
        paths.push(normalPath(path));
    }
    settleModels(paths);
    const scene = paths.find(path => path.endsWith('.json'));
    if (paths.length) openScene(scene || page.path, {keep: !scene});
}

// An error that says what to do instead.
function takeOrTell(files) {
    const say = error => showMessage(`What was dropped cannot be read (${error.message}). Choose it below instead.`);
    files.then(takeFiles).catch(say);
}

document.addEventListener('dragover', event => event.preventDefault());
document.addEventListener('drop', event => {
    event.preventDefault();
    const items = [...event.dataTransfer.items].filter(item => item.kind === 'file').map(itemOf);
    takeOrTell(Promise.all(items.map(filesOf)).then(found => found.flat()));
});
for (const id of ['own-files', 'own-folder'])
    $(id).addEventListener('change', () =>
        takeOrTell(Promise.resolve([...$(id).files].map(file => [file.webkitRelativePath || file.name, file]))),
    );
