// Who looks at the scene from outside: turns about a target, comes nearer, looks from one point at another. The view in
// space (view3d.js) has the canvas, the camera and the directions up, front and side, and draws.
'use strict';

const HALF_ANGLE = 0.4; // of what the onlooker sees, from the middle up

class Onlooker {
    // A floor that goes on for ever would make all else small: what the camera sees counts, without the farthest of it.
    measure(seen) {
        const low = [...this.camera];
        const high = [...this.camera];
        for (let axis = 0; axis < 3; axis++) {
            const sorted = [...seen]
                .filter((x, k) => k % 3 === axis)
                .concat(this.camera[axis])
                .sort((a, b) => a - b);
            low[axis] = Math.min(low[axis], sorted[Math.floor(sorted.length * 0.1)]);
            high[axis] = Math.max(high[axis], sorted[Math.ceil(sorted.length * 0.9) - 1]);
        }
        this.centre = vec.scale(0.5, vec.add(low, high));
        const clamped = p => p.map((x, axis) => Math.max(low[axis], Math.min(high[axis], x)));
        this.size = Math.max(...vec.sub(high, low), 1e-9);
        // A screen larger than all that is seen through it would make that small.
        const isNear = corner => vec.length(vec.sub(corner, this.camera)) < 0.8 * this.size;
        this.extent = [this.camera, ...this.corners.filter(isNear)];
        for (let k = 0; k < seen.length; k += 3) this.extent.push(clamped([...seen.subarray(k, k + 3)]));
    }

    // From where all that counts is seen, as near as can be. What is near takes more room than what is far, so the
    // middle of the picture is found in a few steps.
    whole() {
        Object.assign(this, {target: this.centre, turn: 0.7, tilt: 0.45});
        const [right, up, back] = this.frame();
        for (let k = 0; k < 4; k++) {
            this.distance = this.distanceFor(right, up, back);
            const eye = this.eye();
            for (const axis of [right, up]) {
                const places = this.extent.map(corner => {
                    const p = vec.sub(corner, eye);
                    return vec.dot(p, axis) / -vec.dot(p, back);
                });
                const middle = (Math.min(...places) + Math.max(...places)) / 2;
                this.target = vec.add(this.target, vec.scale(middle * this.distance, axis));
            }
        }
        this.distance = this.distanceFor(right, up, back);
    }

    // How far from its target the onlooker must be to see all that counts.
    distanceFor(right, up, back) {
        const tan = 0.82 * Math.tan(HALF_ANGLE);
        const shape = this.canvas.clientWidth / this.canvas.clientHeight || 1.5;
        const distances = this.extent.map(corner => {
            const p = vec.sub(corner, this.target);
            const aside = Math.max(Math.abs(vec.dot(p, up)), Math.abs(vec.dot(p, right)) / shape);
            return vec.dot(p, back) + aside / tan;
        });
        return Math.max(...distances, 0.1 * this.size);
    }

    move(dx, dy) {
        this.turn -= dx;
        this.tilt = Math.max(-1.57, Math.min(1.57, this.tilt + dy));
        this.draw();
    }
    zoom(factor) {
        this.distance *= factor;
        this.draw();
    }
    centreOn(point) {
        this.target = point;
        this.draw();
    }

    pan(dx, dy) {
        // in pixels
        const [right, up] = this.frame();
        const k = (this.distance * 0.85) / this.canvas.clientHeight;
        this.target = vec.add(this.target, vec.add(vec.scale(-dx * k, right), vec.scale(dy * k, up)));
        this.draw();
    }

    // Looks from one point at another.
    lookFrom(from, to) {
        const back = vec.unit(vec.sub(from, to));
        this.target = to;
        this.distance = vec.length(vec.sub(from, to)) || this.size;
        this.tilt = Math.asin(Math.max(-1, Math.min(1, vec.dot(back, this.up))));
        this.turn = Math.atan2(vec.dot(back, this.side), vec.dot(back, this.front));
        this.draw();
    }

    frame() {
        const level = vec.add(
            vec.scale(Math.cos(this.turn), this.front),
            vec.scale(Math.sin(this.turn), this.side),
        );
        const back = vec.add(vec.scale(Math.cos(this.tilt), level), vec.scale(Math.sin(this.tilt), this.up));
        const right = vec.add(
            vec.scale(-Math.sin(this.turn), this.front),
            vec.scale(Math.cos(this.turn), this.side),
        );
        return [right, vec.cross(back, right), back];
    }

    eye() {
        return vec.add(this.target, vec.scale(this.distance, this.frame()[2]));
    }
}
