"""A virtual display for tests of what rviz shows."""
import contextlib
import os
import subprocess

DEADLINE = 120.0  # [s] of wall time; far more than anything here takes


@contextlib.contextmanager
def screen(width, height):
    """Yields the environment for programs on a separate display without a graphics card."""
    reader, writer = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(writer), "-screen", "0", "%dx%dx24" % (width, height), "+extension", "GLX"]
        + ["-noreset"],  # a client that comes while the server is reset, because the last one has gone, is thrown out
        pass_fds=[writer],
        stderr=subprocess.DEVNULL,
    )
    os.close(writer)
    try:
        with open(reader) as said:
            number = said.readline().strip()
        assert number, "Xvfb ended while it started, with status %s" % server.wait(DEADLINE)
        # llvmpipe of Mesa 22.3 corrupts the heap of about one in ten rviz processes that start on a busy machine, with
        # any plugin or none; softpipe does not
        yield dict(os.environ, DISPLAY=":" + number, LIBGL_ALWAYS_SOFTWARE="1", GALLIUM_DRIVER="softpipe")
    finally:
        server.terminate()
        server.wait(DEADLINE)


def pixels(environment):
    """The contents of the whole display, three bytes per pixel, row by row."""
    return subprocess.run(
        ["import", "-window", "root", "-depth", "8", "rgb:-"],
        check=True,
        capture_output=True,
        env=environment,
        timeout=DEADLINE,
    ).stdout
