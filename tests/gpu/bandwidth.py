"""How fast an OpenCL device copies within its memory, in bytes per second, reading and writing counted. The loader is
called by ctypes, so that nothing but Python is needed."""
import ctypes
import time

MEGABYTES, ROUNDS = 256, 8


def devices(cl):
    """All devices in the loader's order, as `rectray devices` counts them."""
    count = ctypes.c_uint()
    cl.clGetPlatformIDs(0, None, ctypes.byref(count))
    platforms = (ctypes.c_void_p * count.value)()
    cl.clGetPlatformIDs(count, platforms, None)
    found = []
    for platform in platforms:
        here = (ctypes.c_void_p * 64)()
        if cl.clGetDeviceIDs(ctypes.c_void_p(platform), ctypes.c_ulong(0xffffffff), 64, here,
                             ctypes.byref(count)) == 0:
            found += here[:count.value]
    return found


def measure(number):
    """None where the device cannot do it."""
    cl = ctypes.CDLL("libOpenCL.so.1")
    for name in ("clCreateContext", "clCreateCommandQueue", "clCreateBuffer"):
        getattr(cl, name).restype = ctypes.c_void_p
    device, status = ctypes.c_void_p(devices(cl)[number]), ctypes.c_int()
    context = ctypes.c_void_p(cl.clCreateContext(None, 1, ctypes.byref(device), None, None, ctypes.byref(status)))
    queue = ctypes.c_void_p(cl.clCreateCommandQueue(context, device, ctypes.c_ulong(0), ctypes.byref(status)))
    size = ctypes.c_size_t(MEGABYTES << 20)
    buffers = [ctypes.c_void_p(cl.clCreateBuffer(context, ctypes.c_ulong(1), size, None, ctypes.byref(status)))
               for _ in range(2)]
    zero, best = ctypes.c_size_t(0), None
    for _ in range(ROUNDS):
        start = time.perf_counter()
        if cl.clEnqueueCopyBuffer(queue, *buffers, zero, zero, size, 0, None, None) or cl.clFinish(queue):
            return None
        taken = time.perf_counter() - start
        best = taken if best is None else min(best, taken)
    for buffer in buffers:
        cl.clReleaseMemObject(buffer)
    cl.clReleaseCommandQueue(queue)
    cl.clReleaseContext(context)
    return 2 * size.value / best


if __name__ == "__main__":
    print(measure(0))
