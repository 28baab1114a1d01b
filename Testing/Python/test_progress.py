# SPDX-License-Identifier: BSD-3-Clause
"""Progress, cancelling, exceptions and Ctrl-C: the run ends, and nothing is left behind."""

import signal
import traceback
import unittest

import neuralmesh
import numpy as np
import support


class Progress(unittest.TestCase):
    # Promise: progress goes from 0 to 1 without steps back, and does not change the mesh.
    def test_fractions(self):
        fractions = []
        mesh = neuralmesh.reconstruct(support.sphere(), 1000, progress=fractions.append)
        self.assertGreater(len(fractions), 10)
        self.assertEqual(fractions, sorted(fractions))
        self.assertGreaterEqual(fractions[0], 0.0)
        self.assertEqual(fractions[-1], 1.0)
        without = neuralmesh.reconstruct(support.sphere(), 1000)
        self.assertEqual(support.arrays_of(mesh), support.arrays_of(without))

    # Promise: False cancels, also that of numpy, and the mesh so far is valid; nothing else
    # cancels.
    def test_cancel(self):
        quarter = np.float64(0.25)
        mesh = neuralmesh.reconstruct(support.sphere(), 1000, progress=lambda done: done < quarter)
        self.assertEqual(support.stop_reason(mesh), "cancelled")
        self.assertTrue(10 < mesh.GetNumberOfPoints() < 1000)
        self.assertTrue(support.is_closed_manifold(mesh))
        for answer in (None, 0, "", True):
            mesh = neuralmesh.reconstruct(support.sphere(), 100, progress=lambda _: answer)
            self.assertEqual(support.stop_reason(mesh), "vertices")

    # Promise: an exception of the callback ends the run and comes out, with its traceback; the
    # callback is not called again.
    def test_exception(self):
        calls = []

        def fail(done):
            calls.append(done)
            raise LookupError("from the callback")

        try:
            neuralmesh.reconstruct(support.sphere(), 1000, progress=fail)
            self.fail("nothing was raised")
        except LookupError as error:
            self.assertEqual(str(error), "from the callback")
            frames = [frame.name for frame in traceback.extract_tb(error.__traceback__)]
        self.assertEqual(frames[-1], "fail")
        self.assertEqual(len(calls), 1)
        self.assertLess(calls[0], 0.9)
        # The next run is as ever.
        self.assertEqual(neuralmesh.reconstruct(support.sphere(), 100).GetNumberOfPoints(), 100)


class Interrupt(unittest.TestCase):
    # Promise: Ctrl-C ends a run, with or without a callback, as KeyboardInterrupt.
    def test_signal_from_outside(self):
        for progress in ("tell", "None"):
            process = support.start_script(
                f"""
                import neuralmesh, signal, support, warnings
                warnings.simplefilter("ignore")  # more vertices than points: a run that goes on
                signal.signal(signal.SIGINT, signal.default_int_handler)
                cloud = support.sphere(20000)
                tell = lambda done: print("running", flush=True)
                try:
                    print("running", flush=True)
                    neuralmesh.reconstruct(cloud, 100000000, time_limit=1000, progress={progress})
                except KeyboardInterrupt:
                    print("interrupted")
                """
            )
            with self.subTest(progress):
                self.assertEqual(process.stdout.readline(), "running\n")
                if progress == "tell":
                    self.assertEqual(process.stdout.readline(), "running\n")
                process.send_signal(signal.SIGINT)
                output, errors = process.communicate(timeout=support.HANGING)
                self.assertEqual((errors, process.returncode), ("", 0))
                self.assertEqual(output.splitlines()[-1], "interrupted")

    # Promise: Ctrl-C ends a run also if a thread that knows nothing of Python takes the signal.
    def test_signal_to_another_thread(self):
        output, errors, status = support.run_script(
            """
            import ctypes, neuralmesh, signal, support, warnings
            warnings.simplefilter("ignore")  # more vertices than points: a run that goes on
            signal.signal(signal.SIGINT, signal.default_int_handler)
            # Holds on to the interpreter: giving it back would make Python look for signals.
            libc = ctypes.PyDLL(None)
            thread = ctypes.c_ulong()
            libc.pthread_create(ctypes.byref(thread), None, libc.pause, None)
            calls = []
            def interrupt(done):
                calls.append(done)
                if len(calls) == 1:
                    libc.pthread_kill(thread, signal.SIGINT)
            try:
                neuralmesh.reconstruct(
                    support.sphere(20000), 100000000, time_limit=10, progress=interrupt
                )
            except KeyboardInterrupt:
                print("interrupted", calls[-1] < 0.5)
            """
        )
        self.assertEqual((output, errors, status), ("interrupted True\n", "", 0))

    # Promise: a handler of the user's own is called, decides what happens, and is there afterwards.
    def test_own_handler(self):
        received = []

        def handler(number, _frame):
            received.append(number)
            if len(received) == 2:
                raise InterruptedError("second time")

        before = signal.signal(signal.SIGINT, handler)
        try:
            mesh = neuralmesh.reconstruct(
                support.sphere(),
                100,
                progress=lambda _: received or signal.raise_signal(signal.SIGINT),
            )
            self.assertEqual(support.stop_reason(mesh), "vertices")
            with self.assertRaisesRegex(InterruptedError, "second time"):
                neuralmesh.reconstruct(
                    support.sphere(), 100, progress=lambda _: signal.raise_signal(signal.SIGINT)
                )
            self.assertIs(signal.getsignal(signal.SIGINT), handler)
        finally:
            signal.signal(signal.SIGINT, before or signal.SIG_DFL)
        self.assertEqual(received, [signal.SIGINT] * 2)


if __name__ == "__main__":
    unittest.main()
