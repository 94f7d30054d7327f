//! What must hold of every mesh, tried on shapes, motions, orders and damage drawn at random.
//!
//! Without being told otherwise each run tries the same cases, so that what is right today is right tomorrow;
//! `PROPTEST_CASES=2000 PROPTEST_RNG_SEED=7` tries others.

mod damage;
mod drawn;
mod invariance;
mod threads;
