// A worker has a tracer of its own. It renders the rows, and draws the maps, that it is told to. Does nothing in the
// page.
'use strict';

if (typeof document === 'undefined') {
    let tracer = null;
    const files = new Map();

    self.onmessage = async ({data}) => {
        try {
            if (data.open) {
                files.clear();
                for (const [name, bytes] of data.files) files.set(name, bytes);
                tracer = tracer || (await Tracer.make(data.module, files));
                tracer.open(data.open);
                tracer.set(data);
                postMessage({job: data.job});
            } else if (data.map !== undefined) {
                const pixels = tracer.map(data.map);
                postMessage({...data, pixels, low: tracer.value('low'), high: tracer.value('high')}, [
                    pixels.buffer,
                ]);
            } else {
                const pixels = tracer.rows(data.first, data.count, data.step);
                postMessage({...data, pixels}, [pixels.buffer]);
            }
        } catch (error) {
            postMessage({job: data.job, failed: error.message});
        }
    };
}
