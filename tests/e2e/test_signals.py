"""Signals stop the daemon in order, whatever thread the kernel hands them to."""
import signal

from daemon import DaemonTest

ROUNDS = 12


class Signals(DaemonTest):
    def test_one_after_the_other(self):
        # Some of these reached a thread of the BLAS library and ended the process at once.
        for first, second in [(signal.SIGINT, signal.SIGTERM), (signal.SIGTERM, signal.SIGINT)]:
            for _ in range(ROUNDS // 2):
                d = self.start().wait_ready()
                d.process.send_signal(first)
                self.assertEqual(d.stop(second), 0)
                self.assertIn("stopped", d.log())
