//! The plugins Seamline comes with, in one table. The first of a stage is the one taken by default.

use seamline_contour_tracking::ContourTracking;
use seamline_ecs::Registry;
use seamline_kmeans::KMeans;

/// All plugins Seamline comes with. To add one: a dependency and a line.
pub fn registry() -> Registry {
    Registry::default()
        .with::<KMeans>()
        .with::<ContourTracking>()
}
