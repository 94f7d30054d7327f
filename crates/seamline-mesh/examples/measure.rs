use std::time::Instant; use std::path::Path; use glam::DVec3;
use seamline_mesh::*; use seamline_mesh::write::*;
fn grid(n: usize) -> (Vec<DVec3>, Vec<[u32;3]>) {
  let w=n+1; let mut p=vec![]; for i in 0..w { for j in 0..w { let (x,y)=(i as f64/n as f64, j as f64/n as f64); p.push(DVec3::new(x,y,(7.*x).sin()*(5.*y).cos())); } }
  let mut t=vec![]; for i in 0..n { for j in 0..n { let a=(i*w+j) as u32; let b=a+w as u32; t.push([a,b,b+1]); t.push([a,b+1,a+1]); } } (p,t) }
fn time<T>(what:&str, f: impl FnOnce()->T)->T{ let s=Instant::now(); let r=f(); println!("  {what}: {:.3} s", s.elapsed().as_secs_f64()); r }
fn main(){
  let n: usize = std::env::args().nth(1).unwrap().parse().unwrap();
  let full = std::env::args().nth(2).is_none();
  let (p,t)=grid(n); println!("{} triangles", t.len());
  let mut stl=vec![]; time("write stl", || write_stl_binary(&mut stl,&p,&t).unwrap());
  let m=time("read stl",||read_bytes(&stl,Path::new("a.stl")).unwrap());
  let mc=time("clone",||m.clone()); let welded=time("weld 0",||weld(mc,0.0));
  let tol=tolerance_from_share(&m,1e-7); 
  if full { time("weld 1e-7",||weld(m.clone(),tol)); }
  drop(m);
  let topo=time("topology",||Topology::build(welded.positions().len(),welded.triangles.clone()));
  let f=time("examine",||examine(&welded,&topo)); println!("{:?}", f.border_loops);
  let nv=welded.positions().len(); let k=vec![0f32;nv]; let d=vec![[0f32;3];nv]; let pa:Vec<u32>=(0..welded.polygons.face_count() as u32).map(|i|i/1000).collect();
  let mut ply=Vec::new(); time("write ply",||write_ply(&mut ply,&welded.polygons,VertexQuantities{k_min:&k,k_max:&k,d_min:&d,d_max:&d},&pa).unwrap());
  let mut l=vec![]; time("write labels",||write_labels(&mut l,&pa).unwrap());
  if full {
  time("read ply",||read_bytes(&ply,Path::new("a.ply")).unwrap());
  let mut obj=vec![]; time("write obj",||write_obj(&mut obj,&welded.polygons).unwrap());
  time("read obj",||read_bytes(&obj,Path::new("a.obj")).unwrap());
  let mut a=vec![]; time("write ascii",||write_stl_ascii(&mut a,"x",welded.positions(),&welded.triangles).unwrap());
  println!("{} MB obj {} MB stl", obj.len()>>20, a.len()>>20);
  time("read ascii",||read_bytes(&a,Path::new("a.stl")).unwrap()); }
}
