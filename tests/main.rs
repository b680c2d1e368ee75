//! One integration-test binary; each concern is a module beside this file.
